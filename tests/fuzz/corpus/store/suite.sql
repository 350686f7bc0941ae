UPDATE suite SET yaml = '&a [*a]'
UPDATE variant SET name = 'x'
UPDATE version SET value = '2'

UPDATE suite SET yaml = '&a [*a]'
UPDATE version SET value = '2'

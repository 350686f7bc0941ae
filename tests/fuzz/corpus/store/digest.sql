UPDATE realization SET digest = ''
INSERT INTO realization VALUES (0, 1, 'x')

UPDATE result SET rmse = NULL, fit = 1e999 WHERE variant = 0
UPDATE parameter SET truth = 'x'

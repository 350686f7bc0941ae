DELETE FROM parameter WHERE realization = 2
UPDATE parameter SET position = 7

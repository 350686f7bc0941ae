UPDATE result SET identifier = identifier + 1000
DELETE FROM identifier

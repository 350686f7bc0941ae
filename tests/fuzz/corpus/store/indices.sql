UPDATE result SET identifier = identifier + 1000
UPDATE trace SET identifier = -1

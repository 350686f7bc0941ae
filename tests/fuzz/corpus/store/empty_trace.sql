UPDATE trace SET columns = 'a,b,c,d,e', float32 = zeroblob(1000000)
UPDATE trace SET float32 = x'00'

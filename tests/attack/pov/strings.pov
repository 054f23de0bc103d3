#version 3.7;
#debug concat(str(2.5,0,0), "|", str(3.14159,8,3), "|", str(3.14159,-8,3), "|", str(-1,-6,1), "|", str(2,0,-1),
       "\n")
#debug concat(strupr("abC1"), strlwr("ABc"), substr("hello",2,3), chr(65), " ", str(asc("a"),0,0), " ",
       str(strlen("four"),0,0), " ", str(val("12.5e1x"),0,1), " ", str(strcmp("ad","ab"),0,0), "\n")
#debug concat("a\"b", "\u0041", "\n")

au BufRead,BufNewFile *.rt setfiletype strahl

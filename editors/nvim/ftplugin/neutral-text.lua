vim.bo.commentstring = '(* %s *)'
vim.bo.comments = 's1:(*,ex:*)'
require('gradus.buffer').prepare('setlocal commentstring< comments<')

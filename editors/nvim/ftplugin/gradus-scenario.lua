vim.bo.commentstring = '// %s'
vim.bo.comments = '://'
require('gradus.buffer').prepare('setlocal commentstring< comments<')

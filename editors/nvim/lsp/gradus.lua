-- The client's configuration. `vim.lsp.config('gradus', { ... })` changes any part of it.
return require('gradus.client').config()

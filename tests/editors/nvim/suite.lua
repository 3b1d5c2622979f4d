--- The plugin in a real Neovim: nvim --headless -u NONE -l suite.lua PLUGIN
--- where PLUGIN is the folder of the plugin. GRADUS names the executable.
local here = vim.fs.dirname(debug.getinfo(1, 'S').source:sub(2))
package.path = here .. '/?.lua;' .. package.path

-- As a plugin manager does, with the files that Neovim loads at its start.
local plugin = assert(arg[1], 'the folder of the plugin')
vim.opt.runtimepath:prepend(plugin)
vim.cmd('filetype plugin indent on')
vim.cmd('syntax enable')
vim.cmd.runtime('ftdetect/gradus.lua')
vim.cmd.runtime('plugin/gradus.lua')
vim.o.swapfile = false

local harness = require('harness')
vim.lsp.config('gradus', { cmd = { harness.executable, 'lsp' } })

require('without_server')
require('decisions')
require('commands')
require('scenarios')
require('verdicts')

io.stdout:write(('Neovim %s\n'):format(tostring(vim.version())))
local failed = harness.run_all()
for _, client in ipairs(vim.lsp.get_clients()) do
  client:stop()
end
local ended = vim.wait(5000, function()
  return #vim.lsp.get_clients() == 0
end)
if not ended then
  io.stdout:write('FAIL the server did not end when it was asked to\n')
end
vim.fn.delete(harness.scratch, 'rf')
os.exit(failed == 0 and ended and 0 or 1)

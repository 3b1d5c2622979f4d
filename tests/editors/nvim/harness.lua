--- Cases against a real Neovim with the plugin: waiting, reading what is shown, asking the
--- command line what is right. Started by `suite.lua`.
local M = {}

local root = vim.fs.normalize(vim.fs.joinpath(vim.fs.dirname(debug.getinfo(1, 'S').source:sub(2)), '../../..'))
M.executable = vim.env.GRADUS or (root .. '/target/release/gradus')
M.corpus = vim.env.GRADUS_CORPUS or (root .. '/../shared/corpus')
M.cases = vim.json.decode(table.concat(vim.fn.readfile(root .. '/tests/editors/cases.json'), '\n'))
M.scratch = vim.fn.tempname()
vim.fn.mkdir(M.scratch, 'p')

---@param path string
---@return string
function M.read(path)
  local file = assert(io.open(path, 'rb'))
  local text = file:read('a')
  file:close()
  return text
end

---@param path string
---@param text string
function M.write(path, text)
  local file = assert(io.open(path, 'wb'))
  file:write(text)
  file:close()
end

--- Runs a command that must end with 0, and returns what it printed.
---@param ... string
---@return string
function M.gradus(...)
  local result = vim.system({ M.executable, ... }, { text = true }):wait()
  assert(result.code == 0, ('gradus %s ended with %d:\n%s'):format(table.concat({ ... }, ' '), result.code, result.stderr))
  return result.stdout
end

--- Waits until a condition holds, and returns what made it so.
---@generic T
---@param what string
---@param holds fun(): T?
---@param milliseconds? integer
---@return T
function M.wait(what, holds, milliseconds)
  local found
  local came = vim.wait(milliseconds or 10000, function()
    found = holds()
    return found and true or false
  end, 20)
  if not came then
    error('waited in vain: ' .. what, 2)
  end
  return found
end

---@param found any
---@param expected any
---@param what? string
function M.equal(found, expected, what)
  if not vim.deep_equal(found, expected) then
    local difference = type(found) == 'string' and vim.diff(expected .. '\n', found .. '\n') or vim.inspect(found)
    error(('%sexpected and found differ:\n%s'):format(what and what .. ': ' or '', difference), 2)
  end
end

---@param text string
---@param part string
function M.holds(text, part)
  if not text:find(part, 1, true) then
    error(('no %q in:\n%s'):format(part, text), 2)
  end
end

--- A copy of a file of its own, opened, with the client attached.
---@class gradus.Copy
---@field ladder string
---@field spec string
---@field original string
---@field buffer integer

---@param name string a name that no other case uses
---@param file string
---@param before? fun(copy: gradus.Copy) what happens before it is opened
---@return gradus.Copy
function M.open(name, file, before)
  local copy = {
    ladder = vim.fs.joinpath(M.scratch, name .. '.' .. vim.fn.fnamemodify(file, ':e')),
    spec = vim.fs.joinpath(M.scratch, name .. '.grafcet'),
    original = M.read(file),
  }
  M.write(copy.ladder, copy.original)
  if before then
    before(copy)
  end
  vim.cmd.edit(vim.fn.fnameescape(copy.ladder))
  copy.buffer = vim.api.nvim_get_current_buf()
  M.wait('a client', function()
    local client = require('gradus.client').of(copy.buffer)
    return client and client.initialized
  end)
  M.wait('the first analysis', function()
    return vim.b[copy.buffer].gradus_status
  end)
  return copy
end

---@param name string
---@param before? fun(copy: gradus.Copy)
---@return gradus.Copy
function M.tank(name, before)
  return M.open(name, vim.fs.joinpath(root, M.cases.neutralization.file), before)
end

--- Puts the cursor so many characters into the first place that holds a text.
---@param text string
---@param into? integer
function M.go_to(text, into)
  for number, line in ipairs(vim.api.nvim_buf_get_lines(0, 0, -1, false)) do
    local column = line:find(text, 1, true)
    if column then
      vim.api.nvim_win_set_cursor(0, { number, column - 1 + (into or 0) })
      return
    end
  end
  error('the buffer does not hold ' .. text, 2)
end

--- Types keys as a person does, mappings included.
---@param keys string
function M.type(keys)
  vim.api.nvim_feedkeys(vim.keycode(keys), 'mx', false)
end

--- What the floating window says that a key opens.
---@param key string
---@return string?
function M.float(key)
  M.type(key)
  local window = M.wait('a floating window', function()
    for _, each in ipairs(vim.api.nvim_list_wins()) do
      if vim.api.nvim_win_get_config(each).relative ~= '' then
        return each
      end
    end
  end)
  local text = table.concat(vim.api.nvim_buf_get_lines(vim.api.nvim_win_get_buf(window), 0, -1, false), '\n')
  vim.api.nvim_win_close(window, true)
  return text
end

--- Presses the key of code actions and picks the one whose title matches.
---@param pattern string
---@param key? string
---@return string title
function M.act(pattern, key)
  local picked, offered
  local select = vim.ui.select
  ---@diagnostic disable-next-line: duplicate-set-field
  vim.ui.select = function(items, options, choose)
    offered = vim.tbl_map(options.format_item or tostring, items)
    for index, title in ipairs(offered) do
      if title:find(pattern) then
        picked = title
        return choose(items[index], index)
      end
    end
    picked = false
    choose(nil)
  end
  M.type(key or 'gra')
  M.wait('code actions', function()
    return picked ~= nil
  end)
  vim.ui.select = select
  assert(picked, ('no action %q among:\n%s'):format(pattern, table.concat(offered or {}, '\n')))
  return picked
end

---@param path string
---@return integer
function M.buffer_of(path)
  return M.wait(path .. ' is loaded', function()
    local buffer = vim.fn.bufnr(path)
    return buffer > 0 and vim.api.nvim_buf_is_loaded(buffer) and buffer or nil
  end)
end

--- Waits until a buffer has been changed.
---@param path string
function M.is_changed(path)
  M.wait(path .. ' is changed', function()
    local buffer = vim.fn.bufnr(path)
    return buffer > 0 and vim.bo[buffer].modified
  end)
end

--- `:wall`, without its messages.
function M.save_all()
  vim.cmd('silent wall')
end

--- The codes of what the server finds in a buffer.
---@param path string
---@param severity? integer
---@return vim.Diagnostic[]
function M.findings(path, severity)
  local buffer = vim.fn.bufnr(path)
  return buffer > 0 and vim.diagnostic.get(buffer, { severity = severity }) or {}
end

--- The spec that the command line writes for the ladder as it is saved.
---@param copy gradus.Copy
---@param ... string
---@return string
function M.spec_with(copy, ...)
  return M.gradus('convert', copy.ladder, '-o', '-', ...)
end

--- What the command line makes of a spec that exists already.
---@param copy gradus.Copy
---@param spec string
---@param ... string
---@return string
function M.spec_updated(copy, spec, ...)
  local path = copy.spec .. '.copy'
  M.write(path, spec)
  M.gradus('convert', copy.ladder, '-o', path, ...)
  return M.read(path)
end

--- What the command line finds in ladder and spec, as they are saved.
---@param copy gradus.Copy
---@return string[]
function M.saved_findings(copy)
  local answer = vim.json.decode(M.gradus('check', '--json', copy.ladder, copy.spec))
  return vim.tbl_map(function(finding)
    return finding.code .. ' ' .. finding.message
  end, answer.diagnostics)
end

---@type { name: string, run: fun() }[]
local tests = {}

---@param name string
---@param run fun()
function M.test(name, run)
  tests[#tests + 1] = { name = name, run = run }
end

--- Waits until the server owes no answer: Neovim 0.11 complains of an answer for a buffer that
--- is gone.
local function all_is_answered()
  vim.wait(5000, function()
    return vim.iter(vim.lsp.get_clients()):all(function(client)
      return next(client.requests) == nil
    end)
  end, 20)
end

--- Runs every case in an editor without windows or changed buffers left over from the last.
---@return integer failed
function M.run_all()
  local failed = 0
  for _, test in ipairs(tests) do
    local begun = vim.uv.hrtime()
    local passed, trouble = xpcall(test.run, debug.traceback)
    local line = ('%s %s (%d ms)'):format(passed and 'ok  ' or 'FAIL', test.name, (vim.uv.hrtime() - begun) / 1e6)
    io.stdout:write(line, '\n')
    if not passed then
      failed = failed + 1
      io.stdout:write((tostring(trouble):gsub('\n', '\n     ')), '\n')
    end
    vim.cmd('silent! wall!')
    all_is_answered()
    vim.cmd('silent! only!')
    vim.cmd('silent! %bwipeout!')
  end
  io.stdout:write(('%d passed, %d failed\n'):format(#tests - failed, failed))
  return failed
end

return M

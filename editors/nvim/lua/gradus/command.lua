--- `:Gradus` and its subcommands. The work is the server's; here it is asked, and what it
--- answers is shown.
local beside = require('gradus.beside')
local client_of = require('gradus.client').of

local M = {}

---@param message string
---@param level? integer
local function tell(message, level)
  vim.notify('Gradus: ' .. message, level or vim.log.levels.INFO)
end

--- Asks the server to run a command for the current buffer.
---@param command string
---@param argument any
---@param on_answer fun(answer: any)
local function ask(command, argument, on_answer)
  local client = client_of(0)
  if not client then
    tell('no language server for this buffer; :checkhealth gradus tells why', vim.log.levels.WARN)
    return
  end
  local params = { command = command, arguments = { argument } }
  client:request('workspace/executeCommand', params, function(failure, answer)
    if failure then
      tell(failure.message, vim.log.levels.ERROR)
    elseif answer then
      on_answer(answer)
    end
  end)
end

--- The ladder that the current buffer holds, or that its spec belongs to.
---@return string uri
local function ladder()
  local status = vim.b.gradus_status --[[@as gradus.Status?]]
  if vim.bo.filetype == 'grafcet' and status then
    return status.uri
  end
  return vim.uri_from_bufnr(0)
end

---@param answer { uri: string, summary: string, changed: boolean }
local function show_conversion(answer)
  beside.show_uri(answer.uri, false)
  tell((answer.changed and '' or 'nothing to change: ') .. answer.summary)
end

--- The code of the server's finding on the cursor's line, the nearest before the cursor first.
---@return string?
local function code_at_cursor()
  local line, column = unpack(vim.api.nvim_win_get_cursor(0))
  local nearest
  for _, finding in ipairs(vim.diagnostic.get(0, { lnum = line - 1 })) do
    if finding.source == 'gradus' and (not nearest or finding.col <= column) then
      nearest = finding.code
    end
  end
  return nearest
end

--- Asks the server to run a command about the scenario in the current buffer, at the cursor's line.
---@param command string
---@param on_answer fun(answer: any)
---@param scan? integer a scan by its number
local function ask_of_scenario(command, on_answer, scan)
  if vim.bo.filetype ~= 'gradus-scenario' then
    tell('this buffer holds no scenario', vim.log.levels.WARN)
    return
  end
  local line = vim.api.nvim_win_get_cursor(0)[1] - 1
  ask(command, { uri = vim.uri_from_bufnr(0), line = line, scan = scan }, on_answer)
end

--- Shows a table of scans, and says how it went.
---@param answer { title: string, language: string, text: string, summary: string }
local function show_scans(answer)
  beside.show_text(answer)
  tell(answer.summary)
end

---@class gradus.Subcommand
---@field does string
---@field choices? string[] what may follow it
---@field pattern? string what may follow it if it is not one of a few
---@field expects? string that in words
---@field run fun(choice?: string)

---@type table<string, gradus.Subcommand>
local subcommands = {
  convert = {
    does = 'create the spec or bring it up to date',
    choices = { 'none', 'handover', 'witnessed', 'all' },
    run = function(accept)
      ask('gradus.convert', { uri = ladder(), accept = accept }, show_conversion)
    end,
  },
  accept = {
    does = 'accept all handovers',
    run = function()
      ask('gradus.acceptHandovers', { uri = ladder() }, show_conversion)
    end,
  },
  spec = {
    does = 'open the spec beside the ladder',
    run = function()
      ask('gradus.openSpec', { uri = ladder() }, function(spec)
        -- A spec that exists is shown by the server's own window/showDocument.
        if not spec.exists then
          tell('there is no spec beside this ladder yet; :Gradus convert makes one')
        end
      end)
    end,
  },
  ladder = {
    does = 'show the ladder of an XML file as text',
    run = function()
      ask('gradus.ladderText', { uri = ladder() }, beside.show_text)
    end,
  },
  conditions = {
    does = 'show the conditions of all coils',
    run = function()
      ask('gradus.conditions', { uri = ladder() }, beside.show_text)
    end,
  },
  search = {
    does = 'search for sequences of inputs that show which state follows which',
    run = function()
      ask('gradus.search', { uri = ladder() }, function(found)
        tell(found.summary)
      end)
    end,
  },
  verify = {
    does = 'find out whether the spec does what the ladder does',
    run = function()
      ask('gradus.verify', { uri = ladder() }, show_scans)
    end,
  },
  simulate = {
    does = 'run the scenario, and show its scans',
    run = function()
      ask_of_scenario('gradus.simulate', show_scans)
    end,
  },
  scan = {
    does = "show a scan in ladder and spec: that of the cursor's line, or of a number; off takes it back",
    choices = { 'off' },
    pattern = '^%d+$',
    expects = 'the number of a scan, or off',
    run = function(choice)
      if choice == 'off' then
        ask('gradus.hideScan', vim.empty_dict(), function() end)
        return
      end
      ask_of_scenario('gradus.showScan', function(answer)
        tell(('scan %d is shown, after %s'):format(answer.scan, answer.done))
      end, tonumber(choice))
    end,
  },
  explain = {
    does = 'show the page of a code, or of the finding under the cursor',
    pattern = '^G%d%d%d%d$',
    expects = 'a code',
    run = function(code)
      code = code or code_at_cursor()
      if code then
        ask('gradus.explain', code, beside.show_text)
      else
        tell('no finding under the cursor; :Gradus explain G2002 shows the page of a code')
      end
    end,
  },
  report = {
    does = 'write a report for a bug',
    run = function()
      ask('gradus.report', vim.empty_dict(), function(report)
        local editor = ('\n\n## Editor\n\n- Neovim %s\n'):format(tostring(vim.version()))
        beside.show_text(vim.tbl_extend('force', report, { text = report.text .. editor }))
      end)
    end,
  },
  restart = {
    does = 'restart the language server',
    run = function()
      require('gradus.restart').restart()
    end,
  },
  log = {
    does = 'open the log of all language servers',
    run = function()
      vim.cmd.tabnew(vim.fn.fnameescape(vim.lsp.log.get_filename()))
    end,
  },
}

---@return string[]
local function names()
  local all = vim.tbl_keys(subcommands)
  table.sort(all)
  return all
end

---@param subcommand gradus.Subcommand
---@param choice string
---@return boolean
local function takes(subcommand, choice)
  return vim.list_contains(subcommand.choices or {}, choice)
    or subcommand.pattern ~= nil and choice:find(subcommand.pattern) ~= nil
end

--- Runs the scenario that a lens stands above.
---@param uri string
function M.simulate(uri)
  ask('gradus.simulate', { uri = uri }, show_scans)
end

--- Verifies the spec that a lens stands above.
---@param uri string
function M.verify(uri)
  ask('gradus.verify', { uri = uri }, show_scans)
end

---@param words string[]
function M.run(words)
  local name, choice = words[1], words[2]
  if not name then
    local line = require('gradus.status').line()
    tell(line ~= '' and line or 'one of ' .. table.concat(names(), ', '))
    return
  end
  local subcommand = subcommands[name]
  if not subcommand then
    tell(('%s: the subcommands are %s'):format(name, table.concat(names(), ', ')), vim.log.levels.ERROR)
  elseif choice and not takes(subcommand, choice) then
    local expected = subcommand.expects or table.concat(subcommand.choices or { 'nothing' }, ', ')
    tell(('%s: %s takes %s'):format(choice, name, expected), vim.log.levels.ERROR)
  else
    subcommand.run(choice)
  end
end

---@param begun string
---@param line string
---@return string[]
function M.complete(begun, line)
  local before = vim.split(vim.trim(line:sub(1, #line - #begun)), '%s+')
  local choices = names()
  if #before > 1 then
    local subcommand = subcommands[before[2]]
    choices = #before == 2 and subcommand and subcommand.choices or {}
  end
  return vim.tbl_filter(function(choice)
    return vim.startswith(choice, begun)
  end, choices)
end

return M

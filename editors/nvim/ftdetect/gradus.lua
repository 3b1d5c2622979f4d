-- Filetypes are the language names of the protocol. XML stays XML: whether it holds ladder is
-- looked up when the client would attach, not here.
vim.filetype.add({
  extension = {
    ladder = 'gradus-ladder',
    grafcet = 'grafcet',
    scenario = 'gradus-scenario',
    L5K = 'neutral-text',
    l5k = 'neutral-text',
    L5X = 'xml',
    l5x = 'xml',
  },
})

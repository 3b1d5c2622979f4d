" Scenarios: what the plant does, and what is expected.
if exists('b:current_syntax')
  finish
endif

syntax match gradusScenarioExpects '=>'
syntax match gradusScenarioEvent '\<\%(on\|off\)\ze\s\+["%[:alpha:]_]'
syntax match gradusScenarioWait '\<wait\ze\s'
syntax match gradusScenarioTime '\k\@1<!\%([tT]#\)\?\%(\d\+\%(\.\d\+\)\?\%(ms\|[dhms]\)\)\+\k\@!'
syntax match gradusScenarioName '"[^"]*"\|%\k\%(\k\|\.\)*'
syntax match gradusScenarioComment '//.*$' contains=@Spell

highlight default link gradusScenarioExpects Special
highlight default link gradusScenarioEvent Statement
highlight default link gradusScenarioWait Statement
highlight default link gradusScenarioTime Number
highlight default link gradusScenarioName Identifier
highlight default link gradusScenarioComment Comment

let b:current_syntax = 'gradus-scenario'

" Scenarios: what the plant does, and what is expected.
if exists('b:current_syntax')
  finish
endif

syntax match gradusScenarioExpects '=>'
syntax match gradusScenarioEvent '\<\%(on\|off\)\ze\s\+["%[:alpha:]_]'
syntax match gradusScenarioHead '^\s*\%(scenario\|for\|timing\|cycle\)\ze\s'
syntax match gradusScenarioOnly '\<only\ze\s'
syntax match gradusScenarioScan '\<scan\ze\s\+\d'
syntax match gradusScenarioWait '\<wait\ze\s'
syntax match gradusScenarioTime '\k\@1<!\%([tT]#\)\?\%(\d\+\%(\.\d\+\)\?\%(ms\|[dhms]\)\)\+\k\@!'
syntax match gradusScenarioName '"[^"]*"\|%\k\%(\k\|\.\)*'
syntax match gradusScenarioComment '//.*$' contains=@Spell

highlight default link gradusScenarioExpects Special
highlight default link gradusScenarioEvent Statement
highlight default link gradusScenarioWait Statement
highlight default link gradusScenarioHead Keyword
highlight default link gradusScenarioOnly Statement
highlight default link gradusScenarioScan Statement
highlight default link gradusScenarioTime Number
highlight default link gradusScenarioName Identifier
highlight default link gradusScenarioComment Comment

let b:current_syntax = 'gradus-scenario'

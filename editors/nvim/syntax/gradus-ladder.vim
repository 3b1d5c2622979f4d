" Rungs as text: docs/notation.md. What a name is, the server knows and colours.
if exists('b:current_syntax')
  finish
endif
let s:cpo = &cpo
set cpo&vim

syntax match gradusOperator '[*+^]\|/\ze[^/]\|<>\|<=\|>=\|[<>]\|:\?='
syntax match gradusDrives '->'
syntax match gradusNumber '\%(\k\|[.#]\)\@1<!\d\+\%(#[0-9A-Za-z_]\+\|\.\d\+\)\?\%(\k\)\@!'
syntax match gradusTime '\%(\k\|[.#]\)\@1<!\%([tT]#\)\?\%(\d\+\%(\.\d\+\)\?\%(ms\|[dhms]\)\)\+\k\@!'
syntax match gradusAddress '%\k\%(\k\|\.\)*'
syntax match gradusQuoted '"[^"]*"'
syntax match gradusEdge '\<\%(rise\|fall\)\ze\s*('
syntax match gradusTimerBox '\c\<\%(TON\|TOF\|TP\|RTO\|CTU\|CTD\|CTC\|RES\|MCR\)\ze\s*('
" Words only where a name follows.
syntax match gradusWrite '\<\%(set\|reset\|rising\|falling\)\ze\s\+["%[:alpha:]_]'
syntax match gradusJump '\<\%(jump\|call\)\ze\s\+["[:alpha:]_]'
syntax match gradusJump '\<return\%(\s\+program\)\?\ze\s*\%([,)]\|$\|//\)'
syntax match gradusKeyword '\c^\s*\%(program\|routine\|rung\)\%(\k\|\.\)\@!'
syntax match gradusKeyword '\<label\ze\s'
syntax match gradusDeclaration '\c^\s*\%(input\|output\|inout\|internal\|constant\|variable\)\%(\k\|\.\)\@!'
syntax match gradusDeclaration '\<at\ze\s\+["%[:alpha:]_]'
syntax match gradusTitle '\c\%(^\s*rung\s\+\)\@<="[^"]*"'
syntax match gradusType '\c\%(^\s*\%(input\|output\|inout\|internal\|constant\|variable\)\s.*:\s*\)\@<=\%(\k\+\|"[^"]*"\)\ze\s*\%(=\|:=\|//\|$\)'
syntax match gradusComment '//.*$' contains=@Spell

highlight default link gradusOperator Operator
highlight default link gradusDrives Special
highlight default link gradusNumber Number
highlight default link gradusTime Number
highlight default link gradusAddress Constant
highlight default link gradusQuoted Identifier
highlight default link gradusEdge Function
highlight default link gradusTimerBox Function
highlight default link gradusWrite Statement
highlight default link gradusJump Statement
highlight default link gradusKeyword Keyword
highlight default link gradusDeclaration StorageClass
highlight default link gradusTitle String
highlight default link gradusType Type
highlight default link gradusComment Comment

let b:current_syntax = 'gradus-ladder'
let &cpo = s:cpo
unlet s:cpo

" Grafcet rules: docs/notation-grafcet.md.
if exists('b:current_syntax')
  finish
endif
let s:cpo = &cpo
set cpo&vim

syntax match grafcetOperator '[*+^&]\|/\ze[^/]\|<>\|<=\|>=\|[<>]\|:\?='
syntax match grafcetYields '|-\|->'
syntax match grafcetNext '@\%("[^"]*"\|\k\%(\k\|\.\)*\)\?'
syntax match grafcetNumber '\%(\k\|[.#]\)\@1<!\d\+\%(\.\d\+\)\?\k\@!'
syntax match grafcetTime '\%(\k\|[.#]\)\@1<!\%([tT]#\)\?\%(\d\+\%(\.\d\+\)\?\%(ms\|[dhms]\)\)\+\k\@!'
syntax match grafcetAddress '%\k\%(\k\|\.\)*'
syntax match grafcetQuoted '"[^"]*"'
syntax match grafcetEdge '\<\%(rise\|fall\)\ze\s*('
syntax match grafcetLabel '^\s*\%("[^"]*"\|\k\%(\k\|\.\)*\)\ze\s*:=\@!'
syntax match grafcetSection '\c^\s*\%(transitions\|steps\|environment\|never\)\s*:'
syntax match grafcetDeclaration '\c^\s*\%(step\|macro\|enclosing\|transition\|input\|output\|internal\|instance\|marking\|activation\)\ze\%(\s\|$\)'
syntax match grafcetPart '\c^\s*\%(grafcet\|partial\|expansion\|reusable\)\ze\%(\s\|$\)'
syntax match grafcetWord '\%(\k\|\.\)\@1<!\%(for\|of\)\ze\s'
syntax match grafcetWord '\%(|-\s*\)\@<=\%(set\|reset\|force\)\ze\s'
syntax match grafcetWord '\s\@1<=\%(after\|until\)\ze\s\+[0-9tT]'
syntax match grafcetWord '\s\@1<=on\%(\s\+\%(activation\|deactivation\)\)\?\ze\%(\s\|(\|$\)'
syntax match grafcetComment '//.*$' contains=@Spell
syntax match grafcetDecision '^\s*//!\s*\%(accept\|reject\|initial\|keep\|end\)\ze\s.*$' nextgroup=grafcetDecided
syntax match grafcetDecided '.*$' contained contains=grafcetYields,grafcetOperator,grafcetQuoted,grafcetNumber,grafcetComment

highlight default link grafcetOperator Operator
highlight default link grafcetYields Special
highlight default link grafcetNext Identifier
highlight default link grafcetNumber Number
highlight default link grafcetTime Number
highlight default link grafcetAddress Constant
highlight default link grafcetQuoted Identifier
highlight default link grafcetEdge Function
highlight default link grafcetLabel Label
highlight default link grafcetSection Structure
highlight default link grafcetDeclaration Keyword
highlight default link grafcetPart Keyword
highlight default link grafcetWord Statement
highlight default link grafcetComment Comment
highlight default link grafcetDecision PreProc

let b:current_syntax = 'grafcet'
let &cpo = s:cpo
unlet s:cpo

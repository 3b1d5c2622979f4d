" Rockwell rungs as text, alone or in an L5K export.
if exists('b:current_syntax')
  finish
endif

syntax match neutralTextContact '\<\%(XIC\|XIO\|ONS\|OSR\|OSF\|OSRI\|OSFI\)\ze('
syntax match neutralTextCoil '\<\%(OTE\|OTL\|OTU\)\ze('
syntax match neutralTextBox '\<\%(TON\|TOF\|RTO\|CTU\|CTD\|RES\)\ze('
syntax match neutralTextControl '\<\%(JMP\|LBL\|JSR\|SBR\|RET\|MCR\|TND\|AFI\|NOP\|FOR\|BRK\)\ze('
syntax match neutralTextBranch '[][]'
syntax match neutralTextEnd ';'
syntax match neutralTextNumber '\%(\k\|[.#]\)\@1<!-\?\d\+\%(\.\d\+\)\?\k\@!'
syntax match neutralTextUnknown '?'
syntax match neutralTextHead '^\s*\%(\crung\s\+\d\+\|\d\+\|N\|RC\)\s*:=\@!'
syntax match neutralTextComponent '^\s*\%(END_\)\?\%(CONTROLLER\|PROGRAM\|ROUTINE\|ADD_ON_INSTRUCTION_DEFINITION\|DATATYPE\|MODULE\|TASK\|CONNECTION\|TAG\|LOCAL_TAGS\|PARAMETERS\|ENCODED_DATA\)\>'
syntax region neutralTextString start=+"+ skip=+\$"+ end=+"\|$+
syntax region neutralTextString start=+'+ skip=+\$'+ end=+'\|$+
syntax region neutralTextComment start='(\*' end='\*)' contains=@Spell

highlight default link neutralTextContact Function
highlight default link neutralTextCoil Statement
highlight default link neutralTextBox Function
highlight default link neutralTextControl PreProc
highlight default link neutralTextBranch Delimiter
highlight default link neutralTextEnd Delimiter
highlight default link neutralTextNumber Number
highlight default link neutralTextUnknown Special
highlight default link neutralTextHead Label
highlight default link neutralTextComponent Keyword
highlight default link neutralTextString String
highlight default link neutralTextComment Comment

let b:current_syntax = 'neutral-text'

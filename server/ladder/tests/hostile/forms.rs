//! Texts that are bad in one way, as large as is asked for.
//!
//! A text of size `n` holds `n` of what makes it bad, so that one twice as
//! large asks for twice the work and no more.

/// A kind of bad text.
pub struct Form {
    /// What is wrong with it, in a few words.
    pub name: &'static str,
    /// The codes of findings that it must give. Others may come beside them.
    pub codes: &'static [&'static str],
    /// The text of size `n`.
    pub text: fn(usize) -> String,
}

const fn form(
    name: &'static str,
    codes: &'static [&'static str],
    text: fn(usize) -> String,
) -> Form {
    Form { name, codes, text }
}

/// All kinds.
pub const FORMS: &[Form] = &[
    // Nesting.
    form("L5X elements", &["G1005"], |n| l5x(&"<a>".repeat(n))),
    form("PLCopen elements", &["G1005"], |n| {
        plcopen(&"<a>".repeat(n))
    }),
    form("neutral text branches", &["G1201"], |n| {
        neutral(&"[".repeat(n))
    }),
    form("neutral text branches that close", &["G1201"], |n| {
        neutral(&format!("{}XIC(c){}OTE(d);", "[".repeat(n), "]".repeat(n)))
    }),
    form("neutral text operands", &["G1201"], |n| {
        neutral(&format!("CPT(b,{}", "(".repeat(n)))
    }),
    form("neutral text operands that close", &[], |n| {
        format!("CPT(b,{}a{});", "(".repeat(n), ")".repeat(n))
    }),
    form("neutral text indices", &["G1201"], |n| {
        neutral(&format!("OTE(b{}", "[".repeat(n)))
    }),
    form("neutral text indices that close", &[], |n| {
        format!("XIC(a{}0{})OTE(b);", "[b".repeat(n), "]".repeat(n))
    }),
    form("L5K components", &["G1006"], |n| {
        format!("IE_VER := 2.7;\n{}", "CONTROLLER C ()\n".repeat(n))
    }),
    form("L5K programs", &["G1006"], |n| {
        format!("CONTROLLER C ()\n{}", "PROGRAM P ()\n".repeat(n))
    }),
    form("L5K attributes", &["G1006"], |n| {
        format!("CONTROLLER C {}", "(".repeat(n))
    }),
    form("L5K values", &["G1006"], |n| {
        format!("CONTROLLER C ()\nTAG\na : T := {}", "[".repeat(n))
    }),
    form("L5K branches", &["G1201"], |n| {
        l5k(&format!("N: XIC(a){};", "[".repeat(n)))
    }),
    form("ladder parentheses", &["G1101"], |n| ladder(&"(".repeat(n))),
    form("ladder parentheses that close", &["G1101"], |n| {
        ladder(&format!("{}a{} -> v", "(".repeat(n), ")".repeat(n)))
    }),
    form("ladder complements", &["G1101"], |n| {
        ladder(&format!("{}a -> v", "/".repeat(n).replace("//", "/ /")))
    }),
    form("ladder edges", &["G1101"], |n| ladder(&"rise(".repeat(n))),
    form("ladder legs", &["G1101"], |n| ladder(&"a -> (".repeat(n))),
    form("ladder boxes", &["G1101"], |n| {
        ladder(&format!("a -> {}", "PID(".repeat(n)))
    }),
    form("ladder terms", &["G1101"], |n| {
        ladder(&format!("a -> R := {}", "(".repeat(n)))
    }),
    form("ladder indices", &["G1101"], |n| {
        ladder(&format!("a{}", "[".repeat(n)))
    }),
    form("drawn boxes", &[], |n| {
        drawn(&format!("|{}\n", "+-[".repeat(n)))
    }),
    // Width and length.
    form("L5X contacts in series", &[], |n| l5x_rung(&series(n))),
    form("L5X contacts in parallel", &[], |n| l5x_rung(&parallel(n))),
    form("L5K contacts in series", &[], |n| l5k(&series(n))),
    form("L5K contacts in parallel", &[], |n| l5k(&parallel(n))),
    form("neutral text contacts in series", &[], series),
    form("neutral text contacts in parallel", &[], parallel),
    form("ladder contacts in series", &[], |n| {
        ladder(&format!("{} -> v", names(n).join("*")))
    }),
    form("ladder contacts in parallel", &[], |n| {
        ladder(&format!("{} -> v", names(n).join(" + ")))
    }),
    form("PLCopen contacts in series", &[], |n| {
        plcopen(&connected(n, |at| vec![at]))
    }),
    form("PLCopen contacts in parallel", &[], |n| {
        plcopen(&connected(n, |_| vec![0]))
    }),
    form("drawn contacts in series", &[], |n| {
        drawn(&format!("|{}--( )--\n", "--[ ]".repeat(n)))
    }),
    form("drawn contacts in parallel", &[], |n| {
        drawn(&format!("+--[ ]--+--( )--\n{}", "+--[ ]--+\n".repeat(n)))
    }),
    form("rungs", &[], |n| "XIC(a)OTE(b);\n".repeat(n)),
    form("ladder rungs", &[], |n| "rung: a -> b\n".repeat(n)),
    form("drawn rungs", &[], |n| {
        drawn(&"+--[ ]--( )--\n\n".repeat(n))
    }),
    form("PLCopen rungs", &[], |n| plcopen(&connected(n, |_| vec![]))),
    // Many small faults.
    form("L5X end tags of nothing", &["G1004"], |n| {
        l5x(&"</x>".repeat(n))
    }),
    form("PLCopen end tags of nothing", &["G1004"], |n| {
        plcopen(&"</x>".repeat(n))
    }),
    form("PLCopen start tags without end", &["G1004"], |n| {
        plcopen(&"<variable><x></variable>".repeat(n))
    }),
    form("L5X unknown entities", &["G1004"], |n| {
        l5x_rung(&"&x;".repeat(n))
    }),
    form("PLCopen unknown entities", &["G1004"], |n| {
        plcopen(&"&x;".repeat(n))
    }),
    form("L5X characters by number", &["G1201"], |n| {
        l5x_rung(&format!("XIC(a){}", "&#65;".repeat(n)))
    }),
    form("L5X sections", &["G1201"], |n| {
        l5x_rung(&"<![CDATA[XIC(a)]]>".repeat(n))
    }),
    form("L5X attributes", &["G1004"], |n| {
        l5x(&format!("<Programs {}/>", "Name=\"a\" ".repeat(n)))
    }),
    form("PLCopen attributes", &["G1004"], |n| {
        plcopen(&format!("<contact {}/>", "localId=\"1\" ".repeat(n)))
    }),
    form("PLCopen attributes without value", &["G1004"], |n| {
        plcopen(&format!("<contact {}/>", "a ".repeat(n)))
    }),
    form("PLCopen dangling connections", &["G1301"], |n| {
        plcopen(&connected(n, |at| vec![at + 1_000_000_000]))
    }),
    form("PLCopen elements of one number", &[], |n| {
        plcopen(&connected(1, |_| vec![0]).repeat(n))
    }),
    form("PLCopen programs", &[], |n| {
        format!(
            "<project><types><pous>{}</pous></types></project>",
            POU.repeat(n)
        )
    }),
    form("L5K words in a line", &[], |n| {
        format!("CONTROLLER C ()\n{}\nEND_CONTROLLER\n", "A ".repeat(n))
    }),
    form("L5K ends inside of lines", &[], |n| {
        format!(
            "CONTROLLER C ()\n{}\nEND_CONTROLLER\n",
            "FOO ;END_FOO ".repeat(n)
        )
    }),
    form("L5K escaped quotes", &[], |n| {
        format!(
            "CONTROLLER C ()\nTAG\n{};\nEND_TAG\nEND_CONTROLLER\n",
            "$'".repeat(n)
        )
    }),
    form("L5K tags of one name", &[], |n| {
        format!(
            "CONTROLLER C ()\nTAG\n{}END_TAG\nEND_CONTROLLER\n",
            "a : BOOL;\n".repeat(n)
        )
    }),
    form("neutral text rungs that do not close", &["G1201"], |n| {
        neutral(&"XIC(a;[XIC(b);".repeat(n))
    }),
    form("neutral text quotes that do not close", &["G1201"], |n| {
        neutral(&format!("XIC({}", "'$".repeat(n)))
    }),
    form("neutral text words", &["G1201"], |n| {
        neutral(&format!("{};", "NOP ".repeat(n)))
    }),
    form("neutral text signs", &["G1201"], |n| {
        neutral(&format!("{};", "$ ".repeat(n)))
    }),
    form("neutral text comments", &["G1201"], |n| {
        neutral(&"RC: ".repeat(n))
    }),
    form("ladder quotes", &["G1101"], |n| ladder(&"\"".repeat(n))),
    form("ladder arrows", &["G1101"], |n| ladder(&" -> ".repeat(n))),
    form("ladder signs", &["G1101"], |n| ladder(&"$ ".repeat(n))),
    form("ladder names declared again", &["G1102"], |n| {
        ladder(&format!("a -> v\n{}", "input a\n".repeat(n)))
    }),
    form("ladder lines of nothing", &["G1101"], |n| {
        ladder(&format!("a -> v\n\n{}", "x\n".repeat(n)))
    }),
    form("ladder line ends", &[], |n| {
        ladder(&format!("a -> v{}", "\r".repeat(n)))
    }),
    form("ladder comments", &[], |n| {
        ladder(&format!("a -> v\n{}", "// x\n".repeat(n)))
    }),
    form("drawn joints", &[], |n| {
        drawn(&format!("{}\n", "+".repeat(n)))
    }),
    form("drawn tabs", &[], |n| {
        drawn(&format!("|{}--[ ]--( )\n", "\t".repeat(n)))
    }),
    form("drawn comments", &[], |n| drawn(&"(* ".repeat(n))),
    form("drawn names", &[], |n| {
        drawn(&format!("|{}\n+{}\n", " a ".repeat(n), "[ ]".repeat(n)))
    }),
    // Size.
    form("a long name", &[], |n| {
        ladder(&format!("a*{0} -> {0}", "a".repeat(n)))
    }),
    form("a long number", &[], |n| {
        ladder(&format!("(a > {0}) -> R := {0}", "9".repeat(n)))
    }),
    form("a long operand", &[], |n| {
        format!("XIC({0})EQU({0},{1})OTE(b);", "a".repeat(n), "9".repeat(n))
    }),
    form("a long path", &[], |n| {
        format!("XIC(a{})OTE(b);", ".b".repeat(n))
    }),
    form("a long PLCopen expression", &[], |n| {
        let operand = "(a+1)*".repeat(n);
        plcopen(&format!(
            "<inVariable localId=\"1\"><expression>{operand}</expression></inVariable>\
             <outVariable localId=\"2\"><connectionPointIn><connection refLocalId=\"1\"/></connectionPointIn>\
             <expression>b</expression></outVariable>"
        ))
    }),
    form("a PLCopen expression that nests", &[], |n| {
        let operand = "NOT(".repeat(n);
        plcopen(&format!(
            "<inVariable localId=\"1\"><expression>{operand}</expression></inVariable>\
             <outVariable localId=\"2\"><connectionPointIn><connection refLocalId=\"1\"/></connectionPointIn>\
             <expression>b</expression></outVariable>"
        ))
    }),
    form("neutral text escaped quotes in an operand", &[], |n| {
        format!("CPT(b,{})OTE(c);", "$'".repeat(n))
    }),
    form("neutral text programs that are elsewhere", &[], |n| {
        names(n)
            .iter()
            .map(|name| format!("XIC(\\{name}.x)OTE(b);\n"))
            .collect()
    }),
    form("L5K aliases of aliases", &[], |n| {
        let tags: String = names(n)
            .windows(2)
            .map(|pair| format!("{} OF {}.x;\n", pair[0], pair[1]))
            .collect();
        format!(
            "CONTROLLER C ()\nTAG\n{tags}a{n} OF a0;\nEND_TAG\n{}",
            l5k("XIC(a0)OTE(b);")
        )
    }),
    form("L5K programs of one name", &[], |n| {
        format!("CONTROLLER C ()\n{}END_CONTROLLER\n", "PROGRAM P ()\nTAG\na : BOOL;\nEND_TAG\nROUTINE R\nXIC(a)OTE(b);\nEND_ROUTINE\nEND_PROGRAM\n".repeat(n))
    }),
    form("L5X steps of a chart", &[], |n| {
        let steps: String = (0..n)
            .map(|at| format!("<Step ID=\"{at}\" Operand=\"s{at}\"/>"))
            .collect();
        let transitions: String = (0..n)
            .map(|at| format!("<Transition ID=\"t{at}\" Operand=\"t{at}\"/>"))
            .collect();
        let links: String = (0..n)
            .map(|at| format!("<DirectedLink FromID=\"{at}\" ToID=\"t{at}\"/>"))
            .collect();
        l5x(&format!(
            "<Programs><Program Name=\"P\"><Routines><Routine Name=\"R\" Type=\"SFC\"><SFCContent>{steps}{transitions}{links}\
             </SFCContent></Routine></Routines></Program></Programs>"
        ))
    }),
    form("PLCopen blocks in series", &[], |n| {
        let blocks: String = (1..=n).map(|at| format!(
            "<block localId=\"{at}\" typeName=\"ADD\"><inputVariables><variable formalParameter=\"IN1\"><connectionPointIn>\
             <connection refLocalId=\"{}\"/></connectionPointIn></variable><variable formalParameter=\"IN2\"><connectionPointIn>\
             <connection refLocalId=\"{}\"/></connectionPointIn></variable></inputVariables><outputVariables>\
             <variable formalParameter=\"OUT\"/></outputVariables></block>", at - 1, at - 1)).collect();
        plcopen(&blocks)
    }),
    form("PLCopen circle", &["G1303"], |n| {
        plcopen(&connected(n, |at| vec![at]).replace(
            "<connection refLocalId=\"0\"/>",
            &format!("<connection refLocalId=\"{n}\"/>"),
        ))
    }),
    form("PLCopen comments", &[], |n| {
        plcopen(&format!(
            "{}{}",
            connected(n, |_| vec![]),
            "<comment><position x=\"1\" y=\"1\"/><content><p>c</p></content></comment>".repeat(n)
        ))
    }),
    form("PLCopen variables at one address", &[], |n| {
        let variables: String = names(n)
            .iter()
            .map(|name| {
                format!(
                    "<variable name=\"{name}\" address=\"%QX0.0\"><type><BOOL/></type></variable>"
                )
            })
            .collect();
        format!(
            "<project><types><pous><pou name=\"p\" pouType=\"program\"><interface><localVars>{variables}</localVars></interface>\
                 <body><LD/></body></pou></pous></types></project>"
        )
    }),
    form("PLCopen steps of a chart", &[], |n| {
        let steps: String = (1..n).map(|at| format!(
            "<step localId=\"{}\" name=\"s{at}\"><connectionPointIn><connection refLocalId=\"{}\"/></connectionPointIn></step>\
             <transition localId=\"{}\"><connectionPointIn><connection refLocalId=\"{}\"/></connectionPointIn></transition>", 2 * at, 2 * at - 1, 2 * at + 1, 2 * at)).collect();
        format!(
            "<project><types><pous><pou name=\"p\" pouType=\"program\"><body><SFC>{steps}</SFC></body></pou></pous></types></project>"
        )
    }),
    form("ladder words that begin statements", &["G1101"], |n| {
        ladder(&format!("a -> v\n{}", "input\n".repeat(n)))
    }),
    form("ladder labels", &[], |n| {
        ladder(&format!(
            "a -> v\n{}",
            "rung label x: a -> jump x\n".repeat(n)
        ))
    }),
    form("ladder timers", &[], |n| {
        let rungs: String = names(n)
            .iter()
            .map(|name| format!("rung: {name}.Q*a -> TON({name}, 5s)\n"))
            .collect();
        ladder(&format!("a -> v\n{rungs}"))
    }),
    form("ladder parts of names", &[], |n| {
        ladder(&format!("a{} -> v", ".b".repeat(n)))
    }),
    form("drawn boxes side by side", &[], |n| {
        drawn(&format!(
            "|{0}\n|{1}\n|{2}\n|{0}\n",
            " +---+".repeat(n),
            " |TON|".repeat(n),
            "-|IN |".repeat(n)
        ))
    }),
    form("drawn boxes below each other", &[], |n| {
        drawn(&"|  +---+\n|  |TON|\n+--|IN |--( )\n|  +---+\n".repeat(n))
    }),
    form("drawn wires down", &[], |n| {
        drawn(&format!(
            "+--[ ]--+--( )--\n{}+--[ ]--+\n",
            "|       |\n".repeat(n)
        ))
    }),
];

pub fn l5x(inside: &str) -> String {
    format!("<RSLogix5000Content><Controller>{inside}</Controller></RSLogix5000Content>")
}

fn l5x_rung(text: &str) -> String {
    l5x(&format!(
        "<Programs><Program Name=\"P\"><Routines><Routine Name=\"R\" Type=\"RLL\"><RLLContent>\
         <Rung Number=\"0\"><Text>{text}</Text></Rung>\
         </RLLContent></Routine></Routines></Program></Programs>"
    ))
}

fn l5k(rungs: &str) -> String {
    format!(
        "CONTROLLER C ()\nPROGRAM P ()\nROUTINE R\n{rungs}\nEND_ROUTINE\nEND_PROGRAM\nEND_CONTROLLER\n"
    )
}

const POU: &str = "<pou name=\"p\" pouType=\"program\"><body><LD/></body></pou>";

pub fn plcopen(elements: &str) -> String {
    format!(
        "<project><types><pous><pou name=\"p\" pouType=\"program\"><body><LD>\
         <leftPowerRail localId=\"0\"/>{elements}</LD></body></pou></pous></types></project>"
    )
}

/// `n` contacts and a coil for each that nothing else hangs on: each contact
/// is connected as `sources` of its number says, the coil to the last.
fn connected(n: usize, sources: fn(usize) -> Vec<usize>) -> String {
    let mut text = String::new();
    let element = |text: &mut String, tag: &str, id: usize, name: &str, from: &[usize]| {
        let connections: String = from
            .iter()
            .map(|from| format!("<connection refLocalId=\"{from}\"/>"))
            .collect();
        text.push_str(&format!(
            "<{tag} localId=\"{id}\"><position x=\"{id}\" y=\"0\"/><connectionPointIn>{connections}</connectionPointIn>\
             <variable>{name}</variable></{tag}>"
        ));
    };
    for at in 0..n {
        element(
            &mut text,
            "contact",
            at + 1,
            &format!("a{at}"),
            &sources(at),
        );
    }
    let is_parallel = n > 1 && sources(0) == [0] && sources(n - 1) == [0];
    let from: Vec<usize> = if is_parallel {
        (1..=n).collect()
    } else {
        vec![n]
    };
    element(&mut text, "coil", n + 1, "v", &from);
    text
}

fn ladder(condition: &str) -> String {
    format!("rung: a -> b\nrung: {condition}\n")
}

fn neutral(rungs: &str) -> String {
    format!("XIC(a)OTE(b);\n{rungs}")
}

fn drawn(rows: &str) -> String {
    format!("|--[ ]--( )--\n{rows}")
}

fn names(n: usize) -> Vec<String> {
    (0..n).map(|at| format!("a{at}")).collect()
}

fn series(n: usize) -> String {
    let contacts: String = names(n).iter().map(|name| format!("XIC({name})")).collect();
    format!("{contacts}OTE(v);")
}

fn parallel(n: usize) -> String {
    let contacts: Vec<String> = names(n).iter().map(|name| format!("XIC({name})")).collect();
    format!("[{}]OTE(v);", contacts.join(","))
}

//! Rungs of bare neutral text, and the outputs that they drive.

use crate::shown;

/// Reads `text`, about which there is nothing to say, and compares its outputs.
fn check(text: &str, expected: &str) {
    assert_eq!(outputs(text), expected, "{text}");
    assert_eq!(findings(text), "", "{text}");
}

/// The outputs of all rungs with their guards, a line each.
fn outputs(text: &str) -> String {
    let reading = ladder::read(text.as_bytes());
    let rungs = reading.program.rungs();
    let outputs: Vec<String> = rungs.flat_map(|(_, rung)| shown::rung(rung)).collect();
    outputs.join("\n")
}

/// The codes of the findings about `text` and what stands at their places.
fn findings(text: &str) -> String {
    let reading = ladder::read(text.as_bytes());
    let found: Vec<String> = reading
        .diagnostics
        .iter()
        .map(|it| format!("{} `{}`", it.code, &text[it.span.range()]))
        .collect();
    found.join("\n")
}

#[test]
fn contacts_in_series_and_parallel() {
    check("XIC(a)XIO(b)OTE(c);", "a*/b -> OTE c");
    check("[XIC(a) ,XIO(b) ]XIC(c)OTL(d);", "(a + /b)*c -> OTL d");
    check(
        "[XIC(a),XIC(b)][XIC(c),XIC(d)]OTU(e);",
        "(a + b)*c + (a + b)*d -> OTU e",
    );
    check(
        "XIC(a)[XIC(b)[XIC(c),XIC(d)],XIC(e)]OTE(f);",
        "a*b*c + a*b*d + a*e -> OTE f",
    );
    check("AFI()OTE(a);", "0 -> OTE a");
    check("OTE(a);", "1 -> OTE a");
}

#[test]
fn an_empty_leg_lets_power_by() {
    check("XIC(a)[,XIO(b)]OTE(c);", "a + a*/b -> OTE c");
    check("XIC(a)[,]OTE(c);", "a -> OTE c");
    check("[,][XIC(a),]OTE(c);", "a + 1 -> OTE c");
}

#[test]
fn outputs_stand_inside_legs_and_contacts_after_them() {
    check(
        "XIC(a)[OTE(b) XIC(c) OTE(d) ,XIO(e) [OTE(f) ,OTE(g) ] ];",
        "a -> OTE b\na*c -> OTE d\na*/e -> OTE f\na*/e -> OTE g",
    );
    check("XIC(a)OTE(b)XIC(c)OTE(d);", "a -> OTE b\na*c -> OTE d");
}

#[test]
fn edges_of_the_flow() {
    check("XIC(a)ONS(s)OTE(b);", "rise(a; s) -> OTE b");
    check("XIC(a)OSR(s,o)OTE(b);", "rise(a; s) -> OTE o\na -> OTE b");
    check("XIC(a)OSF(s,o);", "fall(a; s) -> OTE o");
}

#[test]
fn comparisons_by_old_and_new_mnemonics() {
    check("EQU(r,10)OTE(a);", "[r = 10] -> OTE a");
    check(
        "GE(r,x.y)NE(r,2#101)OTE(a);",
        "[r >= x.y]*[r <> 2#101] -> OTE a",
    );
    check("CMP(Level > -5)OTE(a);", "[Level > -5] -> OTE a");
    check(
        "CMP(a + b > 5)OTE(c);",
        "1 -> known CMP(|<a <b)\nCMP? -> OTE c",
    );
    check(
        "MEQ(Status,16#F000,16#4000)OTE(c);",
        "1 -> known MEQ(|Source<Status Mask<16#F000 Compare<16#4000)\nMEQ? -> OTE c",
    );
}

#[test]
fn limits() {
    check("LIM(2,r,5)OTE(a);", "[r >= 2]*[r <= 5] -> OTE a");
    check("LIMIT(9,r,3)OTE(a);", "[r >= 9] + [r <= 3] -> OTE a");
    check(
        "LIM(lo,r,5)OTE(a);",
        "1 -> known LIM(|Low Limit<lo Test<r High Limit<5)\nLIM? -> OTE a",
    );
}

#[test]
fn values_written() {
    check("MOV(16#20,r);", "1 -> MOV r := 32");
    check("MOVE(x,r);", "1 -> MOVE r := x");
    check("MOV(0.5,r);", "1 -> MOV r := 0.5 {}");
    check("CLR(r);", "1 -> CLR r := 0");
    check("ADD(R,1,r);", "1 -> ADD R := itself + 1");
    check(
        "ADD(2,r,r)SUB(r,3,r);",
        "1 -> ADD r := itself + 2\n1 -> SUB r := itself + -3",
    );
    check("SUB(5,r,r);", "1 -> SUB r := 5 - r {r}");
    check("MUL(a,60,r);", "1 -> MUL r := a * 60 {a}");
    check("ABS(a[i],r);", "1 -> ABS r := ABS(a[i]) {a[i]}");
    check("CPT(r,r + 1);", "1 -> CPT r := itself + 1");
    check("CPT(r,-7)CPT(r,q);", "1 -> CPT r := -7\n1 -> CPT r := q");
    check(
        "CPT(x,((In_Raw-Min)/(Max - Min))*SQR(A));",
        "1 -> CPT x := ((In_Raw - Min) / (Max - Min)) * SQR(A) {In_Raw,Min,Max,Min,A}",
    );
}

#[test]
fn timers_and_counters() {
    check(
        "XIC(a)TON(T,2000,0);XIC(t.dn)OTE(b);",
        "a -> OnDelay T T.DN Some(2000)\nT.DN -> OTE b",
    );
    check("XIC(a)TOF(T[2],?,?);", "a -> OffDelay T[2] T[2].DN None");
    check(
        "XIC(a)RTO(T,?,?)RES(T);",
        "a -> Retentive T T.DN None\na -> RES T",
    );
    check("XIC(a)CTU(C,5,0);", "a -> Up C C.DN Some(5)");
    check("XIC(a)CTD(C,?,?);", "a -> Down C C.DN None");
}

#[test]
fn flow_of_control() {
    check("XIC(a)JMP(skip);", "a -> jump skip");
    check("LBL(skip)XIC(a)OTE(b);", "1 -> label skip\na -> OTE b");
    check("XIC(a)TND();", "a -> return");
    check("RET(x);", "1 -> known RET(|<x)\n1 -> return");
    check("XIC(a)MCR();", "a -> zone");
    assert_eq!(
        outputs("JSR(Sub,1,In,Out);"),
        "1 -> call Sub(In)\n1 -> JSR Out := JSR(Sub,1,In,Out) {}"
    );
    assert_eq!(findings("JSR(Sub,0);"), "G1205 `Sub`");
}

#[test]
fn boxes_of_the_catalogue_point_their_pins_the_right_way() {
    check(
        "GSV(WALLCLOCKTIME,,LocalDateTime,t[0]);",
        "1 -> known GSV(|Class Name=WALLCLOCKTIME< Instance Name=< Attribute Name=LocalDateTime< Dest>t[0])",
    );
    check(
        "COP(a[0],b[2],1);",
        "1 -> known COP(|Source<a[0] Dest>b[2] Length<1)",
    );
    check(
        "FLL(0,b[2],n);",
        "1 -> known FLL(|Source<0 Dest>b[2] Dest, further elements>b Length<n)",
    );
    check(
        "FSC(c,?,?,ALL,list[c.POS].Code=x);",
        "1 -> known FSC(|Control<>c Length< Position< Mode=ALL< Expression<list[c.POS].Code = x \
         Expression<list[c.POS].Code Expression<x)",
    );
    check("NOP();", "1 -> known NOP(|)");
}

#[test]
fn a_box_that_nobody_knows_is_kept_and_reported_once_for_a_rung() {
    let text = "XIC(a)Odd(x,1)Odd(y)OTE(b);Odd(z);";
    assert_eq!(
        outputs(text),
        "a -> unknown Odd(|<>x <>1)\na*Odd? -> unknown Odd(|<>y)\na*Odd?*Odd? -> OTE b\n\
         1 -> unknown Odd(|<>z)"
    );
    assert_eq!(findings(text), "G2001 `Odd`\nG2001 `Odd`");
}

#[test]
fn one_variable_has_one_name() {
    check(
        "XIC(Start)OTE(Run);XIC(RUN)OTE(start);",
        "Start -> OTE Run\nRun -> OTE Start",
    );
    check(
        "XIC(A.B[3].C.7)OTE(a.b[ 3 ].c.07);",
        "A.B[3].C.7 -> OTE A.B[3].C.7",
    );
    check("XIC(w[Idx])OTE(W[ idx ]);", "w[Idx] -> OTE w[Idx]");
    check("XIC(w.[Idx])OTE(w[i + 1,2]);", "w.[Idx] -> OTE w[i+1,2]");
    check("XIC(s:fs)OTE(\\Other.go);", "S:FS -> OTE go");
    check("XIC(\\P.go)OTE(go);", "P.go -> OTE go");
}

#[test]
fn operands_that_are_missing_get_a_name_of_their_own() {
    let text = "XIC()XIC(?)OTE(a);";
    assert_eq!(outputs(text), "?0*?9 -> OTE a");
    assert_eq!(findings(text), "G1304 `XIC()`\nG1304 `?`");
}

#[test]
fn what_breaks_the_grammar_is_reported_where_it_stands() {
    assert_eq!(findings("XIC(a)OTE(b);NOP;XIC(c)OTE(d);"), "G1201 `NOP`");
    assert_eq!(findings("XIC(a)OTE(b);XIC(c)OTE(d)"), "G1201 ``");
    assert_eq!(findings("XIC(a)OTE(b);[XIC(c)OTE(d);"), "G1201 `[`");
    assert_eq!(findings("XIC(a)OTE(b);XIC(c)$OTE(d);"), "G1201 `$OTE(d)`");
    assert_eq!(
        outputs("XIC(a)OTE(b);XIC(c)$OTE(d)XIC(e);XIC(f)OTE(g);"),
        "a -> OTE b\nc -> unknown $OTE(d)XIC(e)(|)\nf -> OTE g"
    );
    assert_eq!(findings("XIC(a)OTE(b);XIC(c);"), "G1302 `XIC(c);`");
}

#[test]
fn pasted_rungs_may_have_numbers_and_marks_and_comments() {
    let text =
        "RC: \"Start$N\"\n \"it\";\nN: XIC(a)OTE(b);\n7: XIC(c)\n\tOTE(d);\nIR: XIC(e)OTE(f);";
    let reading = ladder::read(text.as_bytes());
    let shown: Vec<(u32, Option<&str>)> = reading
        .program
        .rungs()
        .map(|(_, rung)| (rung.number, rung.comment.as_deref()))
        .collect();
    assert_eq!(shown, [(0, Some("Start\nit")), (7, None)]);
    assert_eq!(outputs(text), "a -> OTE b\nc -> OTE d");
    assert_eq!(findings(text), "G1202 `IR: XIC(e)OTE(f);`");
}

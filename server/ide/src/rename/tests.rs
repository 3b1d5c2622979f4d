use logic::Budget;

use super::*;
use crate::edited;

fn read(ladder: &str, spec: &str) -> (Ladder, Spec) {
    (
        Ladder::read(ladder.into(), &Budget::default()),
        Spec::read(spec.into()),
    )
}

/// A ladder and a spec after the thing at `$0`, in either, was called `new`; or
/// why it was not.
fn renamed(ladder: &str, spec: &str, new: &str) -> Result<(String, String), String> {
    let plain = |text: &str| text.replacen("$0", "", 1);
    let (it, of) = read(&plain(ladder), &plain(spec));
    let renaming = match (ladder.find("$0"), spec.find("$0")) {
        (Some(offset), _) => rename_in_ladder(&it, Some(&of), offset, new, &Budget::default()),
        (None, Some(offset)) => rename_in_spec(&of, Some(&it), offset, new, &Budget::default()),
        (None, None) => panic!("no cursor"),
    };
    let renaming = renaming.expect("a name").map_err(|refusal| refusal.0)?;
    Ok((
        edited(&it.text, &renaming.ladder),
        edited(&of.text, &renaming.spec),
    ))
}

#[track_caller]
fn check(ladder: &str, new: &str, expected: &str) {
    let renamed = renamed(ladder, "", new);
    assert_eq!(renamed, Ok((expected.to_owned(), String::new())));
}

#[track_caller]
fn refused(ladder: &str, new: &str, why: &str) {
    let refusal = renamed(ladder, "", new).expect_err("a refusal");
    assert!(refusal.contains(why), "{refusal}");
}

const TANK: &str = "input s %I0 // Start v1\noutput v1\nrung \"v1\": (s + v$01) * /ls2 -> v1\n";

const SPEC: &str = "\
Step X0, Xv1 for v1 // v1
Transition t1
Input s
Output v1
Transitions:
t1: X0*s*/v1 |- @Xv1
Steps:
Xv1: |- v1
//! initial v1
";

#[test]
fn a_variable_is_renamed_in_ladder_and_spec() {
    let (ladder, spec) = renamed(TANK, SPEC, "fill valve").expect("renamed");
    assert_eq!(
        ladder,
        "input s %I0 // Start v1\noutput \"fill valve\"\nrung \"v1\": (s + \"fill valve\") * /ls2 -> \"fill valve\"\n"
    );
    assert_eq!(
        spec,
        "\
Step X0, \"Xfill valve\" for \"fill valve\" // v1
Transition t1
Input s
Output \"fill valve\"
Transitions:
t1: X0*s*/\"fill valve\" |- @\"Xfill valve\"
Steps:
\"Xfill valve\": |- \"fill valve\"
//! initial \"fill valve\"
"
    );
}

#[test]
fn a_spec_follows_its_ladder_as_well_as_before() {
    let budget = Budget::default();
    let text =
        "input s\ninput ls2\nrung: (s + v1$0) * /ls2 -> v1\nrung: (v2 + ls2*/v1) * /s -> v2\n";
    let ladder = Ladder::read(text.replace("$0", "").into(), &budget);
    let accepted = grafcet::read("//! accept v1 -> v2\n").spec.decisions;
    let spec = recovery::conversion::spec(&ladder.analysis, &accepted, &budget);
    let (ladder, spec) = renamed(text, &grafcet::write(&spec), "fill").expect("renamed");
    let (ladder, spec) = read(&ladder, &spec);
    assert_eq!(
        &*spec.text,
        "\
Step fill_waits  // nothing runs yet
Step Xfill for fill
Step Dfill  // v1 has ended; waits for what follows
Step Xv2 for v2
Transition fill_waits_to_fill, fill_to_Dfill, Dfill_to_v2, v2_to_fill_waits
Input s, ls2
Output v2
Marking fill_waits

Transitions:
fill_waits_to_fill: fill_waits*s*/ls2 |- @Xfill
fill_to_Dfill: Xfill*ls2 |- @Dfill
Dfill_to_v2: Dfill*/s*ls2 |- @Xv2
v2_to_fill_waits: Xv2*s |- @fill_waits

Steps:
Xv2: |- v2

//! accept fill -> v2
"
    );
    assert_eq!(spec.findings(Some(&ladder), &budget), []);
}

#[test]
fn it_is_renamed_from_the_spec_as_well() {
    let from_spec = SPEC.replacen("initial v1", "initial v$01", 1);
    let ladder = TANK.replace("$0", "");
    assert_eq!(
        renamed(&ladder, &from_spec, "fill"),
        renamed(TANK, SPEC, "fill")
    );
}

#[test]
fn names_may_hold_any_letters() {
    check(
        "rung: \u{e4}$0 * \u{e4}.\u{f6} -> \u{fc}\u{e4}\n",
        "\u{1f6d1}",
        "rung: \"\u{1f6d1}\" * \"\u{1f6d1}.\u{f6}\" -> \u{fc}\u{e4}\n",
    );
}

#[test]
fn members_and_terms_follow() {
    check(
        "rung: a * t$01.Q -> TON(t1, 5s)\nrung: t1.Q * (t1.ET > 5) -> b\n",
        "delay",
        "rung: a * delay.Q -> TON(delay, 5s)\nrung: delay.Q * (delay.ET > 5) -> b\n",
    );
    check(
        "rung: 1 -> x := (y - z$0) * 2 + ABS(z), P(z + 1)\n",
        "level",
        "rung: 1 -> x := (y - level) * 2 + ABS(level), P(level + 1)\n",
    );
}

#[test]
fn presets_that_variables_hold_follow() {
    check(
        "rung: go -> TON(t1, wait$0), CTU(c1, wait)\n",
        "pause",
        "rung: go -> TON(t1, pause), CTU(c1, pause)\n",
    );
    check(
        "rung: go$0 -> TON(t1, wait)\n",
        "begin",
        "rung: begin -> TON(t1, wait)\n",
    );
}

#[test]
fn an_address_goes_on_to_mean_the_variable() {
    check(
        "input s$0 %I0\nrung: s * %I0 -> a\n",
        "start",
        "input start %I0\nrung: start * %I0 -> a\n",
    );
    refused(
        "input s %I0\nrung: s * %I$00 -> a\n",
        "start",
        "another spelling of `s`",
    );
}

#[test]
fn words_of_the_notation_are_quoted() {
    check(
        "input \"x y\"\nrung: \"x$0 y\" -> a\n",
        "input",
        "input \"input\"\nrung: \"input\" -> a\n",
    );
    check("rung: a$0 -> set b\n", "set", "rung: \"set\" -> set b\n");
}

#[test]
fn neutral_text_and_l5x_are_renamed_without_regard_to_case() {
    check(
        "XIC(Start$0)[XIC(start),XIC(list[START])]CPT(x,start + 1)OTE(run);",
        "go",
        "XIC(go)[XIC(go),XIC(list[go])]CPT(x,go + 1)OTE(run);",
    );
    check(
        "XIC(list[I$0])XIC(i)OTE(r);",
        "n",
        "XIC(list[n])XIC(n)OTE(r);",
    );
    check("XIC(Start$0)OTE(start);", "START", "XIC(START)OTE(START);");
}

#[test]
fn what_would_change_the_meaning_is_refused() {
    refused("rung: a$0 -> b\n", "b", "the ladder has a `b` already");
    refused(
        "rung: a$0 * t1.Q -> b\n",
        "t1",
        "the ladder has a `t1.Q` already",
    );
    refused("rung: a$0 -> b\n", "b.x", "would be a part of `b`");
    refused("rung: a$0 -> b\n", "%I0", "is an address");
    refused("rung: a$0 -> b\n", "5s", "reads as a number or a time");
    refused("rung: a$0 -> b\n", "x\"y", "quotes");
    refused("rung: a$0 -> b\n", "", "at least one character");
    refused("XIC(a$0)OTE(b);", "not a tag", "letters, digits");
    refused("XIC(a$0)OTE(b);", "OR", "a word of the language");
    refused("XIC(a$0)OTE(B);", "b", "already");
    refused("rung: x > 5$0 -> b\n", "y", "has no name of its own");
    let (ladder, _) = read("rung: a -> b\n", "");
    let taken = renamed("rung: a$0 -> b\n", "Step fill\nInput a\n", "fill");
    assert_eq!(taken, Err("the spec has a step `fill` already".to_owned()));
    assert_eq!(renamable_in_ladder(&ladder, 2), None);
}

#[test]
fn a_place_that_cannot_be_edited_stops_the_renaming() {
    let text = "rung: a$0 -> b\nrung: (a + -> d\n";
    refused(
        text,
        "new",
        "`a` also stands in line 2, where it cannot be renamed safely",
    );
    refused(
        "XIC(a$0)OTE(b);\nJMP(a);",
        "new",
        "`a` also stands in line 2",
    );
}

/// A tag, a routine of rungs, and one of structured text.
fn export(tags: &str, rung: &str, line: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\r\n<RSLogix5000Content TargetType=\"Controller\">\
         <Controller Name=\"C\"><Tags>{tags}</Tags><Programs><Program Name=\"P\" \
         MainRoutineName=\"M\"><Tags/><Routines>\r\n<Routine Name=\"M\" Type=\"RLL\"><RLLContent>\
         <Rung Number=\"0\" Type=\"N\"><Text><![CDATA[{rung}]]></Text></Rung></RLLContent></Routine>\
         <Routine Name=\"S\" Type=\"ST\"><STContent><Line Number=\"0\"><![CDATA[{line}]]></Line>\
         </STContent></Routine></Routines></Program></Programs></Controller></RSLogix5000Content>"
    )
}

#[test]
fn a_tag_of_an_export_is_renamed_where_all_its_places_are_known() {
    let tag = |name: &str| {
        format!(
            "<Tag Name=\"{name}\" TagType=\"Base\" DataType=\"BOOL\">\
             <Description><![CDATA[valve v1]]></Description></Tag>"
        )
    };
    check(
        &export(&tag("v1"), "XIC(s)OTE(V$01);", "x := 1;"),
        "fill",
        &export(&tag("fill"), "XIC(s)OTE(fill);", "x := 1;"),
    );
    refused(
        &export(&tag("v1"), "XIC(s)OTE(v$01);", "v1 := 1;"),
        "fill",
        "`v1` also stands in line",
    );
    let alias = tag("v1") + "<Tag Name=\"w\" TagType=\"Alias\" AliasFor=\"v1\"/>";
    refused(
        &export(&alias, "XIC(s)OTE(v1$0);", ""),
        "fill",
        "another spelling of `w`",
    );
}

#[track_caller]
fn check_spec(spec: &str, new: &str, expected: &str) {
    let renamed = renamed("rung: a -> b\n", spec, new);
    assert_eq!(renamed.map(|(_, spec)| spec), Ok(expected.to_owned()));
}

#[test]
fn steps_transitions_and_parts_belong_to_the_spec() {
    check_spec(
        "Step X$01, X2\r\nTransition t1\r\nMarking X1\r\nTransitions:\r\nt1: X1*5s/X1 |- @X2\r\n//! keep X1\r\n",
        "p 1",
        "Step \"p 1\", X2\r\nTransition t1\r\nMarking \"p 1\"\r\nTransitions:\r\nt1: \"p 1\"*5s/\"p 1\" |- @X2\r\n//! keep \"p 1\"\r\n",
    );
    check_spec(
        "Step X1\nTransition t1\nTransitions:\nt$01: X1 |- @X1\n//! keep t1\n",
        "on",
        "Step X1\nTransition \"on\"\nTransitions:\n\"on\": X1 |- @X1\n//! keep \"on\"\n",
    );
    check_spec(
        "Step X1\nSteps:\nX1: |- force G$01{*}\nPartial G1\nStep X9\n",
        "G2",
        "Step X1\nSteps:\nX1: |- force G2{*}\nPartial G2\nStep X9\n",
    );
}

#[test]
fn instances_take_the_steps_of_their_part_along() {
    let spec = "Input m\nInstance d1 of R(m)\nNever:\nn1: d1.E1*m\nReusable R(p)\nStep E1\nTransition t9\nTransitions:\nt9: E1*p |- @E1\n";
    check_spec(
        &spec.replacen("Step E1", "Step E$01", 1),
        "first",
        &spec.replace("E1", "first"),
    );
    check_spec(
        &spec.replacen("Instance d1", "Instance d$01", 1),
        "door",
        &spec.replace("d1", "door"),
    );
    check_spec(
        &spec.replacen("E1*p", "E1*p$0", 1),
        "go",
        &spec.replace("R(p)", "R(go)").replace("E1*p", "E1*go"),
    );
    let refusal = renamed("", &spec.replacen("d1.E1*m", "d1.E$01*m", 1), "x");
    assert!(refusal.is_err_and(|it| it.contains("step of an instance")));
}

#[test]
fn a_step_cannot_take_the_name_of_a_variable() {
    let spec = "Step X$01\nInput m\nTransition t1\nTransitions:\nt1: X1*m |- @X1\n";
    let refusal = renamed("rung: a -> b\n", spec, "b");
    assert_eq!(refusal, Err("the ladder has a `b` already".to_owned()));
    let refusal = renamed("", spec, "m");
    assert_eq!(
        refusal,
        Err("the spec has a variable `m` already".to_owned())
    );
}

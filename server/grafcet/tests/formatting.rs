//! The canonical layout, statement by statement.

use grafcet::format;

fn check(text: &str, expected: &str) {
    assert_eq!(format(text).text, expected);
    assert_eq!(format(expected).text, expected);
}

#[test]
fn signs_stand_as_in_the_canonical_text() {
    check(
        "Transitions :\n  t1 : p1 * ( a+/ b )*5s / p1|-@p2 * @p3\n t2:p1*Level>=-5|-\n",
        "Transitions:\nt1: p1*(a + /b)*5s/p1 |- @p2*@p3\nt2: p1*Level >= -5 |-\n",
    );
    check(
        "Steps:\np1 :|-C:=C-1 on( activation )\np2:|- force G1 { p3 ,p4 }\n",
        "Steps:\np1: |- C := C - 1 on (activation)\np2: |- force G1{p3, p4}\n",
    );
    check("step a  for Seq = - 1,b\n", "Step a for Seq=-1, b\n");
}

#[test]
fn two_complements_never_become_a_comment() {
    check("Never:\nn1: / /a\n", "Never:\nn1: / /a\n");
}

#[test]
fn comments_stay_where_they_are() {
    check(
        "//   a remark   \nStep p1//first\n\n\n\n  // second\nMarking p1\n",
        "//   a remark\nStep p1  //first\n\n// second\nMarking p1\n",
    );
}

#[test]
fn a_section_has_a_blank_line_before_it_and_its_comment() {
    check(
        "Step p1\n// what it does\nsteps:\np1: |- R",
        "Step p1\n\n// what it does\nSteps:\np1: |- R\n",
    );
}

#[test]
fn what_is_not_understood_is_not_touched() {
    check(
        "Transitions:\n   t1:   p1 *   |-  @\nStep  p1 ,  5\n",
        "Transitions:\n   t1:   p1 *   |-  @\nStep  p1 ,  5\n",
    );
}

#[test]
fn line_ends_and_byte_order_mark_stay() {
    check("\u{feff}Step  p1\r\n", "\u{feff}Step p1\r\n");
    check("", "");
}

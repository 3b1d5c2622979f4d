//! The page that tells every choice names the test that shows it.

#[test]
fn every_test_that_the_page_names_exists_and_every_choice_has_one() {
    let read = |path: &str| std::fs::read_to_string(end_to_end::path(path)).expect("a file");
    let page = read("docs/evolution.md");
    let mut named = 0;
    for reference in page.split('`').filter(|text| text.contains("::")) {
        let [file, test] = reference.split("::").collect::<Vec<_>>()[..] else {
            continue;
        };
        let code = read(&format!("server/grafcet/tests/evolution/{file}.rs"));
        assert!(code.contains(&format!("fn {test}()")), "{reference}");
        named += 1;
    }
    // A choice begins with a sentence in bold print and ends with its test.
    let choices = page.split("\n\n").filter(|text| text.starts_with("**"));
    for choice in choices.clone() {
        assert!(choice.trim_end().ends_with("`)"), "{choice}");
    }
    assert!(named >= choices.count());
}

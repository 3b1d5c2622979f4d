//! What every fixture must give. With `GRADUS_BLESS=1` the expectations are
//! written anew, to be read before they are kept.

use crate::picture::picture;
use crate::places::{repository, xml_files};

#[test]
fn every_fixture_gives_what_stands_beside_it() {
    let files = xml_files(&repository("fixtures/plcopen"));
    assert!(files.len() >= 10, "only {} fixtures found", files.len());
    for file in files {
        let text = std::fs::read(&file).expect("a fixture");
        let found = picture(&ladder::read(&text), &text);
        let beside = file.with_extension("txt");
        if std::env::var_os("GRADUS_BLESS").is_some() {
            std::fs::write(&beside, &found).expect("writing an expectation");
        }
        let expected = std::fs::read_to_string(&beside)
            .unwrap_or_else(|error| panic!("{}: {error}\n{found}", beside.display()));
        assert!(
            found == expected,
            "{} gives\n{found}\ninstead of\n{expected}",
            file.display()
        );
    }
}

//! The least that reading an XML file can cost.

use quick_xml::Reader;
use quick_xml::events::Event;

/// Cuts `bytes` into the events of XML and does nothing with them. How many
/// there were, so that no compiler can leave the work out; none if the bytes
/// are no UTF-8, which this has to find out as a reader of the same bytes does.
pub fn events(bytes: &[u8]) -> usize {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return 0;
    };
    let mut reader = Reader::from_str(text);
    let mut count = 0;
    loop {
        match reader.read_event() {
            Ok(Event::Eof) | Err(_) => return count,
            Ok(_) => count += 1,
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_tag_and_text_is_an_event() {
        assert_eq!(super::events(b"<a>text<b/></a>"), 4);
    }
}

//! Paths as URIs, percent-encoded (RFC 3986).

use std::fmt::Write;
use std::path::{Component, Path};

/// The URI of `path`: relative if it is relative or lies below `root`, else
/// with the `file` scheme.
pub fn of(path: &Path, root: &Path) -> String {
    let inside = path.strip_prefix(root).unwrap_or(path);
    let mut uri = String::new();
    if inside.is_absolute() {
        uri.push_str("file://");
    }
    let mut is_first = true;
    for component in inside.components() {
        let segment = match component {
            Component::RootDir | Component::CurDir => continue,
            Component::Prefix(prefix) => prefix.as_os_str(),
            Component::ParentDir | Component::Normal(_) => component.as_os_str(),
        };
        if !is_first || inside.is_absolute() {
            uri.push('/');
        }
        is_first = false;
        encode(&mut uri, segment.as_encoded_bytes());
    }
    uri
}

/// Everything but unreserved characters is encoded. That includes the colon,
/// which would make a scheme of the first segment.
fn encode(uri: &mut String, segment: &[u8]) {
    for &byte in segment {
        if byte.is_ascii_alphanumeric() || b"-._~".contains(&byte) {
            uri.push(char::from(byte));
        } else {
            // Writing into a string cannot fail.
            let _ = write!(uri, "%{byte:02X}");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn uri(path: &str) -> String {
        of(Path::new(path), Path::new("/plant"))
    }

    #[test]
    fn relative_paths_stay_relative() {
        assert_eq!(
            uri("line 1/Förderer#2.L5X"),
            "line%201/F%C3%B6rderer%232.L5X"
        );
        assert_eq!(uri("./a:b.xml"), "a%3Ab.xml");
        assert_eq!(uri("../a.xml"), "../a.xml");
    }

    #[test]
    fn absolute_paths_below_the_root_become_relative() {
        assert_eq!(uri("/plant/a.xml"), "a.xml");
        assert_eq!(uri("/other/a.xml"), "file:///other/a.xml");
    }
}

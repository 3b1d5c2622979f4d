/// How well `name` answers `query`, the lower the better; `None` if not at all.
///
/// Case does not count. What begins with the query comes before what has a word
/// that does, then what holds it, then what has its characters in order. An
/// empty query takes everything.
pub fn rank(query: &str, name: &str) -> Option<usize> {
    let query: Vec<char> = query.chars().flat_map(char::to_lowercase).collect();
    let name: Vec<char> = name.chars().flat_map(char::to_lowercase).collect();
    if name == query {
        return Some(0);
    }
    let mut starts = (0..name.len()).filter(|&at| name[at..].starts_with(&query));
    let begins_word = |at: usize| at == 0 || !name[at - 1].is_alphanumeric();
    let kind = match starts.clone().find(|&at| begins_word(at)) {
        Some(0) => 1,
        Some(_) => 2,
        None if starts.next().is_some() => 3,
        None => {
            let mut rest = name.iter();
            if !query.iter().all(|wanted| rest.any(|c| c == wanted)) {
                return None;
            }
            4
        }
    };
    // Among equals, the shorter name says more of what was typed.
    Some(kind * LONGEST + name.len().min(LONGEST - 1))
}

/// Longer names are ranked like ones of this length.
const LONGEST: usize = 1000;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_names_come_first() {
        let mut names = vec!["drivel_vent", "Xv1", "Valve 1", "v1", "V10", "pv10"];
        names.retain(|name| rank("v1", name).is_some());
        names.sort_by_key(|name| rank("v1", name));
        assert_eq!(names, ["v1", "V10", "Xv1", "pv10", "Valve 1"]);
    }

    #[test]
    fn nothing_typed_takes_all_and_letters_of_any_script_count() {
        assert!(rank("", "anything").is_some());
        assert!(rank("ÖFF", "öffnen").is_some());
        assert_eq!(rank("v2", "v1"), None);
    }
}

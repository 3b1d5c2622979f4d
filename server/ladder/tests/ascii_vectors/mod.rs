//! Test vectors as drawings of others hold them, in a pragma:
//!
//! ```text
//! { T01
//!   \{ testVect = [ (2, [("a", X False), ("v", I 40)]), (1, [("a", X True)]) ]
//!    , watch    = ["b"]
//!    , expected = [[X False], [X False], [X True]] \}
//! }
//! ```
//!
//! Each pair of `testVect` sets variables and then runs so many scans;
//! `expected` has a row of the watched values for every scan.

use ladder::scan::Datum;

/// Number of scans, and what is set before the first of them.
pub type Step = (u32, Vec<(String, Datum)>);

/// The test vectors of one program.
#[derive(Debug)]
pub struct Vectors {
    pub steps: Vec<Step>,
    pub watch: Vec<String>,
    pub expected: Vec<Vec<Datum>>,
}

/// The test vectors that a text holds, if it holds any.
pub fn vectors(text: &str) -> Option<Vectors> {
    let start = text.find("testVect")?;
    let mut tokens = tokens(&text[start..]);
    tokens.reverse();
    let mut reader = Reader { tokens };
    reader.expect(&["testVect", "="]);
    let steps = reader.list(|reader| {
        reader.expect(&["("]);
        let scans = reader.take().parse().expect("a number of scans");
        reader.expect(&[","]);
        let inputs = reader.list(|reader| {
            reader.expect(&["("]);
            let name = reader.string();
            reader.expect(&[","]);
            let value = reader.datum();
            reader.expect(&[")"]);
            (name, value)
        });
        reader.expect(&[")"]);
        (scans, inputs)
    });
    reader.expect(&[",", "watch", "="]);
    let watch = reader.list(Reader::string);
    reader.expect(&[",", "expected", "="]);
    let expected = reader.list(|reader| reader.list(Reader::datum));
    Some(Vectors {
        steps,
        watch,
        expected,
    })
}

/// Tokens still to be read, the next one last.
struct Reader<'t> {
    tokens: Vec<&'t str>,
}

impl<'t> Reader<'t> {
    fn take(&mut self) -> &'t str {
        self.tokens.pop().expect("more of the test vectors")
    }

    fn expect(&mut self, wanted: &[&str]) {
        for wanted in wanted {
            assert_eq!(self.take(), *wanted);
        }
    }

    fn list<T>(&mut self, mut item: impl FnMut(&mut Self) -> T) -> Vec<T> {
        self.expect(&["["]);
        let mut items = Vec::new();
        while self.tokens.last() != Some(&"]") {
            items.push(item(self));
            if self.tokens.last() == Some(&",") {
                self.take();
            }
        }
        self.expect(&["]"]);
        items
    }

    fn string(&mut self) -> String {
        self.take().trim_matches('"').to_owned()
    }

    fn datum(&mut self) -> Datum {
        match (self.take(), self.take()) {
            ("X", "True") => Datum::Bool(true),
            ("X", "False") => Datum::Bool(false),
            ("I", number) => Datum::Integer(number.parse().expect("a number")),
            other => panic!("{other:?} is no value"),
        }
    }
}

fn tokens(text: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '"' => rest[1..].find('"').map_or(rest.len(), |end| end + 2),
            c if c.is_alphanumeric() => rest
                .find(|c: char| !c.is_alphanumeric())
                .unwrap_or(rest.len()),
            c => c.len_utf8(),
        };
        tokens.push(&rest[..length]);
        rest = rest[length..].trim_start();
    }
    tokens
}

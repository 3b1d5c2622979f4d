//! Documents that no file holds: the server makes them, the client shows them.
//!
//! Their addresses name what they are made from, so that a client can ask for
//! one again at any time (`workspace/textDocumentContent`):
//!
//! | address | shows |
//! |---|---|
//! | `gradus-ladder:/p/tank.L5X.ladder?URI` | the ladder of the document URI in rung notation |
//! | `gradus-conditions:/p/tank.L5X.txt?URI` | the conditions of all its coils |
//! | `gradus-simulation:/p/fill.scenario.txt?URI` | the scans of the scenario URI |
//! | `gradus-verdict:/p/tank.grafcet.txt?URI` | whether the spec URI does what its ladder does |
//! | `gradus-explain:/G2002.md` | the page of a code |
//! | `gradus-explain:/latch.md` | the page of a word |

use std::str::FromStr;
use std::sync::Arc;

use logic::Budget;
use percent_encoding::{NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};
use source::Code;
use tower_lsp::ls_types::Uri;

use super::document::Document;
use super::query::Pair;
use super::requests::verify;
use super::simulation;
use super::world::World;
use crate::command::conditions;
use ide::{Ladder, Term};

/// What a virtual document shows of a ladder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// The ladder in rung notation.
    Ladder,
    /// The conditions of its coils.
    Conditions,
}

impl View {
    fn scheme(self) -> &'static str {
        match self {
            Self::Ladder => "gradus-ladder",
            Self::Conditions => "gradus-conditions",
        }
    }

    /// The ending of its name.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Ladder => "ladder",
            Self::Conditions => "txt",
        }
    }

    /// The language of the text, as clients call it.
    pub fn language(self) -> &'static str {
        match self {
            Self::Ladder => "gradus-ladder",
            Self::Conditions => "plaintext",
        }
    }

    /// The text.
    pub fn text(self, ladder: &Ladder, budget: &Budget) -> String {
        match self {
            Self::Ladder => ladder_text(ladder),
            Self::Conditions => conditions::plain_text(&ladder.analysis, budget),
        }
    }

    /// The address of this view of the document at `uri`.
    pub fn address(self, uri: &Uri) -> Option<Uri> {
        made_of(self.scheme(), uri, self.ending())
    }
}

/// The address of what is made of the document at `uri`.
pub fn made_of(scheme: &str, uri: &Uri, ending: &str) -> Option<Uri> {
    let path = uri.path().as_str();
    let slash = if path.starts_with('/') { "" } else { "/" };
    let of = utf8_percent_encode(uri.as_str(), NON_ALPHANUMERIC);
    Uri::from_str(&format!("{scheme}:{slash}{path}.{ending}?{of}")).ok()
}

/// The ladder in rung notation, above it what that has no words for.
fn ladder_text(ladder: &Ladder) -> String {
    let written = ladder::text::write(ladder.program());
    let lost = written.lost.iter();
    let notes: String = lost
        .map(|lost| format!("// this text leaves out {}\n", lost.what))
        .collect();
    notes + &written.text
}

const PAGE: &str = "gradus-explain";

/// What a page explains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Page {
    /// A finding.
    Code(Code),
    /// A word that hovers use.
    Term(Term),
}

impl Page {
    /// The page that is called `name`.
    fn called(name: &str) -> Option<Self> {
        let term = || Term::called(name).map(Self::Term);
        Code::parse(name).map(Self::Code).or_else(term)
    }

    fn text(self) -> &'static str {
        match self {
            Self::Code(code) => code.page(),
            Self::Term(term) => term.page(),
        }
    }
}

/// The address of a page.
pub fn page(page: Page) -> Option<Uri> {
    let name = match page {
        Page::Code(code) => code.to_string(),
        Page::Term(term) => term.name().to_owned(),
    };
    Uri::from_str(&format!("{PAGE}:/{name}.md")).ok()
}

/// The text of the virtual document at `uri`, if there is one.
pub fn text(world: &World, uri: &Uri, budget: &Budget) -> Option<String> {
    let scheme = uri.scheme().as_str();
    if scheme == PAGE {
        // Pages lead to each other as files do, from folder to folder.
        let name = uri.path().as_str().rsplit('/').next()?;
        let page = Page::called(name.strip_suffix(".md")?)?;
        return Some(page.text().to_owned());
    }
    if scheme == simulation::SCHEME {
        let simulated = simulation::simulated(world, &made_from(world, uri)?)?;
        return Some(simulated.text);
    }
    if scheme == verify::SCHEME {
        let pair = Pair::of(world, &made_from(world, uri)?);
        return verify::shown(world, &pair);
    }
    let mut views = [View::Ladder, View::Conditions].into_iter();
    let view = views.find(|view| view.scheme() == scheme)?;
    let document = made_from(world, uri)?;
    let ladder: &Arc<Ladder> = document.ladder()?;
    Some(view.text(ladder, budget))
}

/// The document that the virtual one at `uri` is made from.
pub fn made_from(world: &World, uri: &Uri) -> Option<Arc<Document>> {
    let of = percent_decode_str(uri.query()?.as_str())
        .decode_utf8()
        .ok()?;
    world.document(&Uri::from_str(&of).ok()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_names_its_document_whatever_that_is_called() {
        let uri = Uri::from_str("file:///p/a%20b/tank.L5X").expect("an address");
        let address = View::Ladder.address(&uri).expect("an address");
        assert_eq!(address.path().as_str(), "/p/a%20b/tank.L5X.ladder");
        let of = address.query().expect("a query").as_str();
        assert_eq!(percent_decode_str(of).decode_utf8_lossy(), uri.as_str());
    }

    #[test]
    fn the_page_of_a_code_is_the_one_that_explain_prints() {
        let code = source::codes::DOUBLE_COIL;
        let address = page(Page::Code(code)).expect("an address");
        assert_eq!(text_at(address.as_str()).as_deref(), Some(code.page()));
    }

    #[test]
    fn pages_lead_from_one_to_the_other_as_their_files_do() {
        let latch = Some(Term::Latch.page().to_owned());
        assert_eq!(text_at("gradus-explain:/latch.md"), latch);
        let code = source::codes::DOUBLE_COIL.page().to_owned();
        assert_eq!(text_at("gradus-explain:/diagnostics/G2002.md"), Some(code));
        assert_eq!(text_at("gradus-explain:/nothing.md"), None);
        assert_eq!(text_at("gradus-explain:/latch"), None);
    }

    fn text_at(address: &str) -> Option<String> {
        let uri = Uri::from_str(address).expect("an address");
        text(&World::default(), &uri, &Budget::default())
    }
}

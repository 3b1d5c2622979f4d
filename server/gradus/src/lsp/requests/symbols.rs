//! `textDocument/documentSymbol` and `workspace/symbol`.

use ide::symbols::{
    Symbol, SymbolKind as Kind, rank, symbols_of_ladder, symbols_of_scenario, symbols_of_spec,
};
use tower_lsp::ls_types::{
    DocumentSymbol, DocumentSymbolResponse, Location, SymbolInformation, SymbolKind,
    WorkspaceSymbolResponse,
};

use crate::lsp::query::{Query, Text};
use crate::lsp::world::World;

/// Everything that the document holds: a tree where the client has trees.
pub fn of_document(query: &Query) -> Option<DocumentSymbolResponse> {
    let symbols = match query.text()? {
        Text::Ladder(ladder) => symbols_of_ladder(ladder),
        Text::Spec(spec) => symbols_of_spec(spec),
        Text::Scenario(scenario) => symbols_of_scenario(scenario),
    };
    if query.world.abilities.symbol_trees {
        let tree = symbols.iter().map(|it| tree(query, it)).collect();
        return Some(DocumentSymbolResponse::Nested(tree));
    }
    let mut flat = Vec::new();
    flatten(query, &symbols, None, &mut flat);
    Some(DocumentSymbolResponse::Flat(flat))
}

#[expect(deprecated, reason = "the protocol's type still has the old field")]
fn tree(query: &Query, symbol: &Symbol) -> DocumentSymbol {
    let children = symbol.children.iter().map(|it| tree(query, it));
    DocumentSymbol {
        name: shown(&symbol.name),
        detail: symbol.detail.clone(),
        kind: kind(symbol.kind),
        tags: None,
        deprecated: None,
        range: query.range(symbol.whole),
        selection_range: query.range(symbol.span),
        children: Some(children.collect()),
    }
}

fn flatten(
    query: &Query,
    symbols: &[Symbol],
    container: Option<&str>,
    flat: &mut Vec<SymbolInformation>,
) {
    for symbol in symbols {
        let location = query.location(&query.document, symbol.whole);
        flat.push(information(symbol.kind, &symbol.name, location, container));
        flatten(query, &symbol.children, Some(&symbol.name), flat);
    }
}

/// Names that are sent to a client, at most. It asks again as more is typed.
const MOST: usize = 500;

/// The names in all folders that answer what was typed, best first; `None` once
/// the answer is not `wanted` any more.
pub fn in_folders(
    world: &World,
    typed: &str,
    wanted: &dyn Fn() -> bool,
) -> Option<WorkspaceSymbolResponse> {
    let all = world.index.all(world, wanted)?;
    let typed = typed.trim();
    let entries = all.iter().flat_map(|file| {
        let entries = file.entries.iter();
        entries.map(move |entry| (&file.uri, entry))
    });
    let ranked = entries.filter_map(|(uri, entry)| Some((rank(typed, &entry.name)?, uri, entry)));
    let mut ranked: Vec<_> = ranked.collect();
    // Stable: equals stay in the order of files and places.
    ranked.sort_by_key(|(rank, ..)| *rank);
    let best = ranked.iter().take(MOST).map(|(_, uri, entry)| {
        let location = Location::new((*uri).clone(), entry.range);
        information(
            entry.kind,
            &entry.name,
            location,
            entry.container.as_deref(),
        )
    });
    Some(WorkspaceSymbolResponse::Flat(best.collect()))
}

#[expect(deprecated, reason = "the protocol's type still has the old field")]
fn information(
    of: Kind,
    name: &str,
    location: Location,
    container: Option<&str>,
) -> SymbolInformation {
    SymbolInformation {
        name: shown(name),
        kind: kind(of),
        tags: None,
        deprecated: None,
        location,
        container_name: container.map(str::to_owned),
    }
}

/// Clients refuse a symbol without a name.
fn shown(name: &str) -> String {
    match name.trim().is_empty() {
        true => "(no name)".to_owned(),
        false => name.to_owned(),
    }
}

/// What comes nearest among the kinds of the protocol.
fn kind(kind: Kind) -> SymbolKind {
    match kind {
        Kind::Program | Kind::Grafcet | Kind::Scenario => SymbolKind::MODULE,
        Kind::Routine => SymbolKind::FUNCTION,
        Kind::Rung => SymbolKind::OPERATOR,
        Kind::State => SymbolKind::ENUM_MEMBER,
        Kind::Value => SymbolKind::CONSTANT,
        Kind::Coil => SymbolKind::VARIABLE,
        Kind::Box => SymbolKind::OBJECT,
        Kind::Label => SymbolKind::KEY,
        Kind::Part => SymbolKind::CLASS,
        Kind::Section => SymbolKind::NAMESPACE,
        Kind::Step => SymbolKind::ENUM_MEMBER,
        Kind::Transition | Kind::ScenarioStep => SymbolKind::EVENT,
        Kind::Action => SymbolKind::METHOD,
        Kind::Rule => SymbolKind::PROPERTY,
    }
}

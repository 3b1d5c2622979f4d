//! Call hierarchy: which step follows which.

use ide::hierarchy::{self, Direction, Item, Neighbour, Stage};
use serde::{Deserialize, Serialize};
use tower_lsp::ls_types::{
    CallHierarchyIncomingCall, CallHierarchyItem, CallHierarchyOutgoingCall, Position, Range,
    SymbolKind,
};

use crate::lsp::query::Query;

/// What an item is about, kept by the client.
#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Data {
    State(String),
    Step(String),
}

/// The state or step at a position.
pub fn prepare(query: &Query, at: Position) -> Option<Vec<CallHierarchyItem>> {
    let pair = query.pair();
    let stage = hierarchy::stage_at(pair.looked_at(), query.side()?, query.offset(at))?;
    Some(vec![item(query, stage)?])
}

/// What follows an item.
pub fn outgoing(
    query: &Query,
    asked: &CallHierarchyItem,
) -> Option<Vec<CallHierarchyOutgoingCall>> {
    let calls = neighbours(query, asked, Direction::After)?;
    let calls = calls.into_iter().filter_map(|(neighbour, from_ranges)| {
        Some(CallHierarchyOutgoingCall {
            to: item(query, neighbour)?,
            from_ranges,
        })
    });
    Some(calls.collect())
}

/// What an item follows.
pub fn incoming(
    query: &Query,
    asked: &CallHierarchyItem,
) -> Option<Vec<CallHierarchyIncomingCall>> {
    let calls = neighbours(query, asked, Direction::Before)?;
    let calls = calls.into_iter().filter_map(|(neighbour, from_ranges)| {
        Some(CallHierarchyIncomingCall {
            from: item(query, neighbour)?,
            from_ranges,
        })
    });
    Some(calls.collect())
}

fn neighbours(
    query: &Query,
    asked: &CallHierarchyItem,
    direction: Direction,
) -> Option<Vec<(Item, Vec<Range>)>> {
    let stage = match serde_json::from_value(asked.data.clone()?).ok()? {
        Data::State(name) => Stage::State(name.into()),
        Data::Step(name) => Stage::Step(name.into()),
    };
    let pair = query.pair();
    let found = hierarchy::neighbours(pair.looked_at(), &stage, direction, &query.budget);
    let ranged = |Neighbour { item, from }: Neighbour| {
        let document = pair.document(item.at.side)?;
        let ranges = from.iter();
        let ranges = ranges.map(|it| query.encoding().range(&document.rope, *it));
        let ranges = ranges.collect();
        Some((item, ranges))
    };
    Some(found.into_iter().filter_map(ranged).collect())
}

fn item(query: &Query, item: Item) -> Option<CallHierarchyItem> {
    let pair = query.pair();
    let document = pair.document(item.at.side)?;
    let name = item.stage.name().to_string();
    let data = match item.stage {
        Stage::State(_) => Data::State(name.clone()),
        Stage::Step(_) => Data::Step(name.clone()),
    };
    Some(CallHierarchyItem {
        name,
        kind: SymbolKind::ENUM_MEMBER,
        tags: None,
        detail: Some(item.detail),
        uri: document.uri.clone(),
        range: query.encoding().range(&document.rope, item.at.whole),
        selection_range: query.encoding().range(&document.rope, item.at.name),
        data: serde_json::to_value(data).ok(),
    })
}

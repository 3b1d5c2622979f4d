//! Wires traced: which ends of which elements are one point.

use petgraph::unionfind::UnionFind;

use super::symbols::{Drawing, Mark, SymbolKind};

/// A point of the drawing that is electrically one.
pub(super) type Net = usize;

/// An end of an element: where a wire may be.
#[derive(Clone, Debug)]
pub(super) struct End {
    pub(super) net: Net,
    /// The pin, for a box.
    pub(super) pin: Option<String>,
    /// The row it is in.
    pub(super) row: usize,
}

/// The ends of one symbol.
#[derive(Clone, Debug, Default)]
pub(super) struct Ends {
    pub(super) left: Vec<End>,
    pub(super) right: Vec<End>,
}

/// All that wires join.
#[derive(Clone, Debug)]
pub(super) struct Wires {
    /// The ends of each symbol of the drawing.
    pub(super) ends: Vec<Ends>,
    /// The net of the left rail.
    pub(super) rail: Net,
    /// The column of the left rail.
    pub(super) rail_column: usize,
}

/// Cells of a row: the net that passes it horizontally and the one that
/// passes it vertically.
type Cells = Vec<[Option<Net>; 2]>;

/// Traces all wires of a drawing.
pub(super) fn trace(drawing: &Drawing) -> Wires {
    let rail = 0;
    let mut nets = 1;
    let rail_column = rail_column(drawing);
    let cells = cells(drawing, rail_column, &mut nets);
    let mut ends = ends(drawing, &mut nets);
    let mut joined = UnionFind::new(nets);
    let mut join = |a: Option<Net>, b: Option<Net>| {
        if let (Some(a), Some(b)) = (a, b) {
            joined.union(a, b);
        }
    };
    let cell = |row: usize, column: usize| -> [Option<Net>; 2] {
        let row = cells.get(row);
        row.and_then(|row| row.get(column))
            .copied()
            .unwrap_or_default()
    };
    for (row, marks) in drawing.marks.iter().enumerate() {
        join(cell(row, rail_column)[1], Some(rail));
        for column in 0..marks.len() {
            let [across, down] = cell(row, column);
            join(across, cell(row, column + 1)[0]);
            join(down, cell(row + 1, column)[1]);
        }
    }
    // Symbols that touch each other are in series without a wire.
    for (at, symbol) in drawing.symbols.iter().enumerate() {
        for end in &ends[at].left {
            let outside = symbol.columns.start.checked_sub(1);
            join(
                outside.and_then(|column| cell(end.row, column)[0]),
                Some(end.net),
            );
        }
        for end in &ends[at].right {
            join(cell(end.row, symbol.columns.end)[0], Some(end.net));
            let neighbour = drawing.symbols.get(at + 1);
            if neighbour
                .is_some_and(|next| next.row == end.row && next.columns.start == symbol.columns.end)
            {
                let first = ends[at + 1].left.first();
                join(first.map(|first| first.net), Some(end.net));
            }
        }
    }
    for ends in &mut ends {
        for end in ends.left.iter_mut().chain(&mut ends.right) {
            end.net = joined.find(end.net);
        }
    }
    Wires {
        ends,
        rail: joined.find(rail),
        rail_column,
    }
}

/// The leftmost column in which a row begins with `|` or `+`.
fn rail_column(drawing: &Drawing) -> usize {
    let first_mark = |row: &Vec<Mark>| {
        let column = row.iter().position(|mark| *mark != Mark::Blank)?;
        matches!(row[column], Mark::Bar | Mark::Plus).then_some(column)
    };
    drawing
        .marks
        .iter()
        .filter_map(first_mark)
        .min()
        .unwrap_or(0)
}

fn cells(drawing: &Drawing, rail_column: usize, nets: &mut usize) -> Vec<Cells> {
    let mut new = || {
        *nets += 1;
        Some(*nets - 1)
    };
    let conducts = |mark| matches!(mark, Mark::Dash | Mark::Plus | Mark::Solid);
    let mut rows = Vec::with_capacity(drawing.marks.len());
    for (at, row) in drawing.marks.iter().enumerate() {
        let cells = row.iter().enumerate().map(|(column, mark)| match mark {
            Mark::Blank | Mark::Solid => [None, None],
            Mark::Dash => [new(), None],
            Mark::Plus => {
                let net = new();
                [net, net]
            }
            Mark::Bar if column == rail_column => {
                let net = new();
                [net, net]
            }
            // A wire that meets a `|` from both sides crosses it.
            Mark::Bar => {
                let left = column.checked_sub(1).map(|left| drawing.mark(at, left));
                let crossed = left.is_some_and(conducts) && conducts(drawing.mark(at, column + 1));
                [if crossed { new() } else { None }, new()]
            }
        });
        rows.push(cells.collect());
    }
    rows
}

fn ends(drawing: &Drawing, nets: &mut usize) -> Vec<Ends> {
    let mut end = |row: usize, pin: Option<&String>| {
        *nets += 1;
        End {
            net: *nets - 1,
            pin: pin.cloned(),
            row,
        }
    };
    let mut all = Vec::with_capacity(drawing.symbols.len());
    for symbol in &drawing.symbols {
        let mut ends = Ends::default();
        match &symbol.kind {
            SymbolKind::Box(found) => {
                ends.left = found
                    .left
                    .iter()
                    .map(|(row, pin)| end(*row, Some(pin)))
                    .collect();
                ends.right = found
                    .right
                    .iter()
                    .map(|(row, pin)| end(*row, Some(pin)))
                    .collect();
            }
            SymbolKind::Jump(_) | SymbolKind::Return(_) => ends.left.push(end(symbol.row, None)),
            SymbolKind::Contact(_) | SymbolKind::Coil(_) => {
                ends.left.push(end(symbol.row, None));
                ends.right.push(end(symbol.row, None));
            }
        }
        all.push(ends);
    }
    all
}

//! Readers of XML against a bare pass over the events of the same bytes.

use std::time::Duration;

use bench::measure::{in_turn, ratio, time};
use bench::real::{RealFile, files};
use bench::xml;

use super::Row;

const ROUNDS: usize = 9;

/// The aim: a reader costs at most so many bare passes.
const MOST: f64 = 2.5;

/// The rows of both formats; none without the corpus.
pub fn rows() -> Vec<Row> {
    ["l5x", "plcopen"].into_iter().flat_map(of_format).collect()
}

fn of_format(format: &str) -> Vec<Row> {
    let files = files(format);
    let times: Vec<(&RealFile, (Duration, Duration))> = files
        .iter()
        .filter_map(|file| Some((file, times(&file.bytes)?)))
        .collect();
    let Some((largest, of_largest)) = times.iter().max_by_key(|(file, _)| file.bytes.len()) else {
        return Vec::new();
    };
    let worst = times.iter().max_by(|(_, a), (_, b)| {
        let order = |(ours, peer): &(Duration, Duration)| ratio(*ours, *peer);
        order(a).total_cmp(&order(b))
    });
    let ours = times.iter().map(|(_, (ours, _))| ours).sum();
    let peer = times.iter().map(|(_, (_, peer))| peer).sum();
    let against = "bare XML events";
    let all = format!("reading all {} files, {format}", times.len());
    let large = format!("reading the largest, {}", size(largest));
    let mut rows = vec![
        Row::times(all, against, (ours, peer), Some(MOST)),
        Row::times(large, against, *of_largest, Some(MOST)),
    ];
    if let Some((file, times)) = worst {
        let what = format!("reading the worst, {}", size(file));
        rows.push(Row::times(what, against, *times, Some(MOST)));
    }
    rows
}

fn size(file: &RealFile) -> String {
    format!("`{}`, {} KB", file.name, file.bytes.len() / 1000)
}

fn times(bytes: &[u8]) -> Option<(Duration, Duration)> {
    let mut ours = || time(|| ladder::read(bytes));
    let mut peer = || time(|| xml::events(bytes));
    match in_turn(ROUNDS, &mut [&mut ours, &mut peer])[..] {
        [ours, peer] => Some((ours, peer)),
        _ => None,
    }
}

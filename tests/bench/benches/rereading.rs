//! Reading a plant of 13,000 rungs after a keystroke, beside reading all of it.

use std::hint::black_box;
use std::sync::Arc;

use bench::plant::plant;
use criterion::{Criterion, criterion_group, criterion_main};
use ladder::{Edition, reread};

const RUNGS: usize = 13_000;

/// A plant and the plant with `typed` behind the last `mark` in its first
/// two thirds.
fn edit(mark: &str, typed: &str) -> (Edition, Arc<str>) {
    let before = plant(RUNGS);
    let most = before.len() / 3 * 2;
    let at = before[..most].rfind(mark).map(|at| at + mark.len());
    let (above, below) = before.split_at(at.unwrap_or(most));
    let after = format!("{above}{typed}{below}");
    (Edition::new(before.into()), after.into())
}

fn rereading(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("13,000 rungs");
    group.sample_size(20);
    let text: Arc<str> = plant(RUNGS).into();
    group.bench_function("read", |bencher| {
        bencher.iter(|| black_box(ladder::read(text.as_bytes())));
    });
    for (what, mark, typed) in [
        ("reread after a letter", "rung \"Lamp\": (m", "x"),
        ("reread after a rung", "_lamp\n", "rung: stop -> alarm\n"),
        ("reread after a declaration", "_lamp\n", "output alarm\n"),
    ] {
        let (before, after) = edit(mark, typed);
        group.bench_function(what, |bencher| {
            bencher.iter(|| black_box(reread(&before, after.clone())));
        });
    }
    group.finish();
}

criterion_group!(benches, rereading);
criterion_main!(benches);

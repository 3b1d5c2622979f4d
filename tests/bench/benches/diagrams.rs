//! The guards of all real rungs, built by Gradus and by OxiDD. Without the
//! corpus nothing is measured.

use bench::diagrams::{Own, build};
use bench::guards::of_corpus;
use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};

fn diagrams(criterion: &mut Criterion) {
    let Some(guards) = of_corpus() else {
        return;
    };
    let (rungs, peer) = (&guards.rungs, &guards.peer);
    let mut group = criterion.benchmark_group("guards of the corpus");
    let count = guards.measured() as u64;
    group
        .throughput(Throughput::Elements(count))
        .sample_size(10);
    group.bench_function("gradus", |bencher| {
        let library = Own::default();
        bencher.iter(|| {
            rungs
                .iter()
                .map(|rung| build(rung, &library))
                .collect::<Vec<_>>()
        });
    });
    group.bench_function("oxidd", |bencher| {
        bencher.iter_batched(
            || peer.forget(),
            |()| {
                rungs
                    .iter()
                    .map(|rung| build(rung, peer))
                    .collect::<Vec<_>>()
            },
            BatchSize::PerIteration,
        );
    });
    group.finish();
}

criterion_group!(benches, diagrams);
criterion_main!(benches);

fn main() {
    for n in [1000, 3000, 10000] {
        let text = bench::plant::plant(n);
        let t = std::time::Instant::now();
        let r = ladder::read(text.as_bytes());
        let read = t.elapsed();
        let b = logic::Budget::default();
        let t = std::time::Instant::now();
        let mut c = recovery::conditions::conditions(&r.program, &b);
        let tc = t.elapsed();
        let t = std::time::Instant::now();
        let s = recovery::states::states(&c, &b);
        let ts = t.elapsed();
        let t = std::time::Instant::now();
        let regs = recovery::registers::registers(&r.program, &mut c, &b);
        let tr = t.elapsed();
        let t = std::time::Instant::now();
        let su = recovery::successions::ranked(&c, &s, &regs, &b);
        let tsu = t.elapsed();
        let t = std::time::Instant::now();
        let g = recovery::groups::groups(&c, &s, &regs, &su);
        let tg = t.elapsed();
        println!(
            "{n}: {} bytes read {read:?} cond {tc:?} states {ts:?} regs {tr:?} succ {tsu:?} ({}) groups {tg:?} ({}) peak {:?}",
            text.len(),
            su.len(),
            g.len(),
            bench::memory::peak()
        );
    }
}

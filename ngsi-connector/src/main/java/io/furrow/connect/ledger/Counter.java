package io.furrow.connect.ledger;

import java.util.concurrent.atomic.LongAdder;

/** A number that only grows, from 0 at the start of the task; any thread may add to it. */
public final class Counter {
    private final String name;
    private final String help;
    private final LongAdder sum = new LongAdder();

    /** At zero. */
    public Counter(String name, String help) {
        this.name = name;
        this.help = help;
    }

    /** In camel case, as on {@code /health}. */
    public String name() {
        return name;
    }

    /** A sentence without its full stop: what is counted, and its unit. */
    public String help() {
        return help;
    }

    public void increment() {
        sum.increment();
    }

    public void add(long count) {
        sum.add(count);
    }

    public long sum() {
        return sum.sum();
    }
}

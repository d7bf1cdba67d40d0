package io.furrow.soak.replay;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.BitSet;
import java.util.List;
import java.util.SortedMap;
import java.util.TreeMap;

/** Collects the records of a replay's topic by epoch and sequence, and finds faults. */
final class PlayedEpochs {
    private static final String EVENT = "event";
    private static final String END = "end";

    private final SortedMap<Long, SortedMap<Long, List<Entry>>> epochs = new TreeMap<>();
    private int records;

    /**
     * A record.
     *
     * @param kind event, prime or end
     * @param number of the event in its mission; −1 for other kinds
     */
    record Entry(String kind, int partition, long number) {}

    void add(long epoch, long sequence, Entry entry) {
        epochs.computeIfAbsent(epoch, any -> new TreeMap<>())
                .computeIfAbsent(sequence, any -> new ArrayList<>())
                .add(entry);
        records++;
    }

    int count() {
        return epochs.size();
    }

    int records() {
        return records;
    }

    /** The number of sequences that occur more than once, except ends, which are written to every partition. */
    long repeated() {
        return epochs.values().stream()
                .flatMap(epoch -> epoch.values().stream())
                .filter(entries -> entries.size() > 1 && !isEnd(entries))
                .count();
    }

    private static boolean isEnd(List<Entry> entries) {
        return entries.stream().allMatch(entry -> entry.kind().equals(END));
    }

    /** Sequences that are missing before the last one of an epoch. */
    List<String> gaps() {
        List<String> gaps = new ArrayList<>();
        epochs.forEach((epoch, sequences) -> {
            long expected = 0;
            for (long sequence : sequences.keySet()) {
                if (sequence != expected) {
                    gaps.add("epoch %d: %d to %d are missing".formatted(epoch, expected, sequence - 1));
                }
                expected = sequence + 1;
            }
        });
        return gaps;
    }

    /** Sequences with different events: a sequence of an epoch that was reused. */
    List<String> changed() {
        List<String> changed = new ArrayList<>();
        epochs.forEach((epoch, sequences) -> sequences.forEach((sequence, entries) -> {
            long[] numbers = entries.stream()
                    .filter(entry -> entry.kind().equals(EVENT))
                    .mapToLong(Entry::number)
                    .distinct()
                    .toArray();
            if (numbers.length > 1) {
                changed.add("epoch %d: %d has the events %s".formatted(epoch, sequence, Arrays.toString(numbers)));
            }
        }));
        return changed;
    }

    /** Faults of a topic on which each record must be exactly once. */
    List<String> faultsOfExactlyOnce(int partitions) {
        List<String> faults = new ArrayList<>();
        epochs.forEach((epoch, sequences) -> {
            long previous = -1;
            for (var each : sequences.entrySet()) {
                List<Entry> entries = each.getValue();
                Entry entry = entries.get(0);
                if (!isEnd(entries) && entries.size() > 1) {
                    faults.add("epoch %d: %d is there %d times".formatted(epoch, each.getKey(), entries.size()));
                }
                if (entry.kind().equals(EVENT)) {
                    if (previous >= 0 && entry.number() != previous + 1) {
                        faults.add("epoch %d: event %d follows event %d".formatted(epoch, entry.number(), previous));
                    }
                    previous = entry.number();
                }
            }
            List<Entry> last = sequences.get(sequences.lastKey());
            BitSet ended = new BitSet();
            last.forEach(entry -> ended.set(entry.partition()));
            if (!isEnd(last) || last.size() != partitions || ended.cardinality() != partitions) {
                faults.add("epoch %d does not end once on each partition, but with %s".formatted(epoch, last));
            }
        });
        return faults;
    }
}

package io.furrow.bench.load;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

/** Messages and delays over time, by second. */
final class Timeline {
    private final Map<Long, long[]> counts = new TreeMap<>();
    private final Map<Long, long[]> delays = new TreeMap<>();

    /** @param stamps when device, source, ingest and reader had a message, epoch ms */
    void add(long... stamps) {
        for (int place = 0; place < stamps.length; place++) {
            counts.computeIfAbsent(stamps[place] / 1000, none -> new long[4])[place]++;
        }
        long[] sums = delays.computeIfAbsent(stamps[0] / 1000, none -> new long[3]);
        for (int hop = 0; hop < sums.length; hop++) {
            sums[hop] += stamps[hop + 1] - stamps[hop];
        }
    }

    List<LoadSecond> seconds() {
        List<LoadSecond> seconds = new ArrayList<>();
        counts.forEach((second, count) -> {
            List<Double> means = Arrays.stream(delays.getOrDefault(second, new long[0]))
                    .mapToObj(sum -> sum / (double) count[0])
                    .toList();
            long first = counts.keySet().iterator().next();
            seconds.add(new LoadSecond(second - first, count[0], count[1], count[2], count[3], means));
        });
        return seconds;
    }
}

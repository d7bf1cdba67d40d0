package io.furrow.analytics.presence;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;

import io.furrow.analytics.Seeds;
import io.furrow.analytics.position.PositionFix;
import io.furrow.analytics.presence.Plot.Box;

/**
 * A random story of a few hundred milliseconds: devices that walk over a grid of whole steps, so that they often stand on borders, fall
 * silent and report twice at an instant; fields that overlap, have holes and parts, change, end and come back.
 */
final class Story {
    static final long BOUND = 40;
    private static final double STEP = 1e-4;
    private static final long START = 1_700_000_000_000L;
    private static final int SIZE = 12;

    final PresenceRules rules;
    final List<PositionFix> fixes = new ArrayList<>();
    final List<Plot> plots;
    private final Random random;

    Story(long seed) {
        random = Seeds.random(seed);
        rules = new PresenceRules(
                Duration.ofMillis(15 + random.nextInt(60)),
                Duration.ofMillis(random.nextInt(3) == 0 ? 0 : random.nextInt(30)));
        for (int device = 0; device < 4; device++) {
            walk("d" + device);
        }
        Map<String, Plot> byKey = new HashMap<>();
        for (int version = 0; version < 10; version++) {
            Plot plot = plot("f" + random.nextInt(4), random.nextInt(3) == 0 ? START : START + random.nextInt(400));
            byKey.put(plot.id() + plot.validFrom(), plot);
        }
        plots = byKey.values().stream()
                .sorted(Comparator.comparing(Plot::validFrom).thenComparing(Plot::id))
                .toList();
    }

    /** Each position at most {@link #BOUND} behind a newer one. */
    List<PositionFix> arrivals() {
        Map<PositionFix, Long> delays = new HashMap<>();
        fixes.forEach(fix -> delays.put(fix, fix.time() + random.nextInt((int) BOUND)));
        return fixes.stream().sorted(Comparator.comparing(delays::get)).toList();
    }

    private void walk(String id) {
        int x = random.nextInt(SIZE);
        int y = random.nextInt(SIZE);
        for (long time = START + random.nextInt(60); time < START + 400; time += pause()) {
            x = Math.floorMod(x + random.nextInt(5) - 2, SIZE);
            y = Math.floorMod(y + random.nextInt(5) - 2, SIZE);
            fixes.add(fix(id, x, y, time));
        }
    }

    private int pause() {
        return switch (random.nextInt(12)) {
            case 0 -> 0;
            case 1 -> 100;
            default -> 1 + random.nextInt(15);
        };
    }

    private Plot plot(String id, long validFrom) {
        if (random.nextInt(5) == 0) {
            return new Plot(id, validFrom, List.of(), null);
        }
        int west = random.nextInt(6);
        int south = random.nextInt(6);
        int width = 2 + random.nextInt(5);
        int height = 2 + random.nextInt(5);
        List<Box> parts = new ArrayList<>(List.of(box(west, south, west + width, south + height)));
        if (random.nextInt(3) == 0) {
            parts.add(box(west + width + 1, south, west + width + 3, south + 2));
        }
        Box hole = width > 3 && height > 3 ? box(west + 1, south + 1, west + width - 1, south + height - 1) : null;
        return new Plot(id, validFrom, parts, hole);
    }

    private static Box box(int west, int south, int east, int north) {
        return new Box(at(west), at(south), at(east), at(north));
    }

    static PositionFix fix(String id, int x, int y, long time) {
        return new PositionFix("data.raw", "farm|/|" + id, id, "", "", "", at(y), at(x), Double.NaN, Double.NaN, time);
    }

    /** Not 0: the position 0,0 is none. */
    private static double at(int step) {
        return 1 + STEP * step;
    }
}

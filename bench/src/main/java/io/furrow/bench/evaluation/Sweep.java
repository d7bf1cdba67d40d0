package io.furrow.bench.evaluation;

import java.time.Duration;
import java.util.List;
import java.util.Locale;
import java.util.stream.IntStream;

import io.furrow.simulators.load.LoadPlan;

/** The sweeps of the evaluation with their points: one quantity grows, the others are constant. */
public enum Sweep {
    /** 5 devices report at growing rates. */
    PERIOD("shorter periods of 5 devices"),
    /** A growing number of devices report every 200 ms. */
    DEVICES("more devices"),
    /** Messages of 50 devices become larger. */
    PAYLOAD("larger messages of 50 devices"),
    /** The context broker notifies of each change once per subscription. */
    SUBSCRIPTIONS("more copies of each notification");

    private static final int KILOBYTE = 1_000;
    private static final int MIN_PERIOD_MS = 1;

    private final String title;

    Sweep(String title) {
        this.title = title;
    }

    /**
     * One load of a sweep.
     *
     * @param copies notifications of each change
     */
    public record Point(Sweep sweep, int devices, int periodMs, int payloadBytes, int copies) {
        /** Notifications per second. */
        public double rate() {
            return devices * 1000.0 / periodMs * copies;
        }

        /** The growing quantity: kilobytes in the sweep of the payload, notifications per second in the others. */
        public double abscissa() {
            return sweep == PAYLOAD ? payloadBytes / (double) KILOBYTE : rate();
        }

        String title() {
            return switch (sweep) {
                case PERIOD -> periodMs + " ms";
                case DEVICES -> devices + (devices == 1 ? " device" : " devices");
                case PAYLOAD -> payloadBytes / KILOBYTE + " kB";
                case SUBSCRIPTIONS -> copies + (copies == 1 ? " subscription" : " subscriptions");
            };
        }

        LoadPlan plan(Duration duration, String domain) {
            String mission = sweep.name().toLowerCase(Locale.ROOT) + "-" + title().replaceAll("\\D", "");
            return new LoadPlan(devices, Duration.ofMillis(periodMs), payloadBytes, duration, domain, mission);
        }
    }

    public List<Point> points() {
        IntStream values = switch (this) {
            case PERIOD -> IntStream.of(1000, 100, 40, 20, 10, 8);
            case DEVICES -> IntStream.of(1, 10, 25, 50, 100, 125);
            case PAYLOAD -> IntStream.of(1, 10, 50, 65, 80, 100);
            case SUBSCRIPTIONS -> IntStream.of(1, 2, 3, 4, 5, 6, 30);
        };
        return values.mapToObj(this::point).toList();
    }

    private Point point(int value) {
        return switch (this) {
            case PERIOD -> new Point(this, 5, value, KILOBYTE, 1);
            case DEVICES -> new Point(this, value, 200, KILOBYTE, 1);
            case PAYLOAD -> new Point(this, 50, 200, value * KILOBYTE, 1);
            case SUBSCRIPTIONS -> new Point(this, 25, 200, KILOBYTE, value);
        };
    }

    /** A point with twice the load of the last one, to find the knee; null if devices cannot report more often. */
    Point further(Point last) {
        return switch (this) {
            case PERIOD -> last.periodMs() == MIN_PERIOD_MS ? null : point(last.periodMs() / 2);
            case DEVICES -> point(2 * last.devices());
            case PAYLOAD -> point(2 * last.payloadBytes() / KILOBYTE);
            case SUBSCRIPTIONS -> point(2 * last.copies());
        };
    }

    String title() {
        return title;
    }

    /** The title of {@link Point#abscissa}. */
    String abscissa() {
        return this == PAYLOAD ? "kB a message" : "notifications a second";
    }
}

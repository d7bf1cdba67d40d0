package io.furrow.bench.whole;

import java.util.List;
import java.util.Locale;

/** The measurements of a whole suite; devices are zero for those that are not loads. */
enum Part {
    /** {@code ./furrow up} without load. */
    IDLE(0),
    /** {@code ./furrow demo}. */
    DEMO(0),
    /** 125 devices with 1 kB a second each. */
    LOAD_125(125),
    /** 625 devices with 1 kB a second each. */
    LOAD_625(625);

    private final int devices;

    Part(int devices) {
        this.devices = devices;
    }

    int devices() {
        return devices;
    }

    List<Figure> figures() {
        return devices == 0
                ? List.of(Figure.START_SECONDS, Figure.CORES, Figure.THREADS, Figure.RESIDENT_MB)
                : List.of(
                        Figure.DELIVERED,
                        Figure.CPU_MS_PER_MESSAGE,
                        Figure.P50_MS,
                        Figure.P95_MS,
                        Figure.P99_MS,
                        Figure.THREADS,
                        Figure.RESIDENT_MB);
    }

    String title() {
        return name().toLowerCase(Locale.ROOT).replace('_', ' ');
    }

    /** A result of a part. */
    enum Figure {
        /** From the command to the table of addresses. */
        START_SECONDS,
        /** Processor time divided by time. */
        CORES,
        THREADS,
        RESIDENT_MB,
        /** Share of the messages sent. */
        DELIVERED,
        /** Of the whole process, sender and reader included, until the last message arrived. */
        CPU_MS_PER_MESSAGE,
        P50_MS,
        P95_MS,
        P99_MS;

        String title() {
            return name().toLowerCase(Locale.ROOT).replace('_', ' ');
        }
    }
}

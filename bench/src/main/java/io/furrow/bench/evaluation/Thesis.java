package io.furrow.bench.evaluation;

import java.util.List;
import java.util.Map;

/** Results that the text of the thesis states. Its figures show curves without numbers. */
final class Thesis {
    static final String CONDITIONS =
            "For comparison, the platform of the thesis ran Orion, IoT Agent and broker on a machine of their own (six cores, 64 GB) and"
                    + " Draco on a third:";

    static final List<String> FINDINGS = List.of(
            "stable up to 250 messages per second, at most 500 in almost every situation; beyond that, gaps without messages and peaks of"
                    + " 1.5 s delay;",
            "at 250 messages per second, 50 kB was the largest payload without loss; 65 kB had 6 s of delay, 100 kB more than 8 s;",
            "identical subscriptions multiplied the received messages up to three subscriptions;",
            "in every experiment the IoT Agent crashed once and messages were lost.");

    private static final double BEYOND_500_MS = 1_500;
    private static final double AT_65_KB_MS = 6_000;
    private static final double AT_100_KB_MS = 8_000;

    private Thesis() {}

    /** The abscissa beyond which messages were lost. */
    static double fellBeyond(Sweep sweep) {
        return switch (sweep) {
            case PERIOD, DEVICES -> 500;
            case PAYLOAD -> 50;
            case SUBSCRIPTIONS -> 375;
        };
    }

    /** Delays in ms by abscissa: averages over the payload, peaks over the rate; empty for subscriptions. */
    static Map<Double, Double> delays(Sweep sweep) {
        return switch (sweep) {
            case PERIOD -> Map.of(625.0, 1_000.0);
            case DEVICES -> Map.of(625.0, BEYOND_500_MS);
            case PAYLOAD -> Map.of(65.0, AT_65_KB_MS, 100.0, AT_100_KB_MS);
            case SUBSCRIPTIONS -> Map.of();
        };
    }
}

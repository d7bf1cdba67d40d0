package io.furrow.bench.evaluation;

import java.util.Map;

/** Results that the text of the thesis states. Its figures show curves without numbers. */
final class Thesis {
    static final String SENTENCE = """
            The platform of the thesis, with Orion, IoT Agent and broker on a machine of their own (six cores, 64 GB) and Draco on a third: stable to
            250 messages a second, a cap of 500 in almost every situation, moments without any message and peaks of delay of 1.5 s beyond; 50 kB at 250
            messages a second as the largest payload without loss, 6 s of delay at 65 kB and more than 8 s at 100 kB; identical subscriptions multiplied what
            was received up to three of them; in every experiment the IoT Agent crashed once and messages were lost.""";

    private static final double BEYOND_500_MS = 1_500;
    private static final double AT_65_KB_MS = 6_000;
    private static final double AT_100_KB_MS = 8_000;

    private Thesis() {}

    /** The abscissa beyond which reception fell. */
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

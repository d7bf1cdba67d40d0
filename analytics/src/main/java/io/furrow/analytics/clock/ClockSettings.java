package io.furrow.analytics.clock;

import picocli.CommandLine.Option;

/** Options for the clocks of devices. Holds no Flink type, like the options of every job. */
public final class ClockSettings {
    /** Whether times are corrected. */
    public enum Correction {
        OFF,
        ON
    }

    @Option(
            names = "--clock-correction",
            paramLabel = "on|off",
            defaultValue = "off",
            description =
                    "on: estimate the clock offset of each device from the receipt of its messages (header ts-source) "
                            + "and correct its times by 1 s to 10 min; --clock-output reports the offset. With off, positions of a "
                            + "device that is further behind than --out-of-orderness are late. Replays are never corrected. "
                            + "Default: ${DEFAULT-VALUE}.")
    private Correction correction;

    public boolean correct() {
        return correction == Correction.ON;
    }
}

package io.furrow.analytics.clock;

import picocli.CommandLine.Option;

/** What a job does about the clocks of devices. Holds no Flink type, as the options of every job. */
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
                    "on: learn by how much the clock of each device is off, from when its messages were received (header"
                            + " ts-source), and correct its times, from 1 s up to 10 min; --clock-output reports it. Without it"
                            + " the positions of a device that is further behind than --out-of-orderness do not count."
                            + " Replays are never corrected. Default: ${DEFAULT-VALUE}.")
    private Correction correction;

    public boolean correct() {
        return correction == Correction.ON;
    }
}

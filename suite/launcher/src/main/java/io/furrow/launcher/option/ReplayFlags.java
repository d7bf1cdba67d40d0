package io.furrow.launcher.option;

import java.time.Duration;

import picocli.CommandLine.Option;

import io.furrow.cli.option.CommandException;
import io.furrow.control.replay.ReplaySettings;

/** Options of the control plane for replays. */
public final class ReplayFlags {
    @Option(
            names = "--mongo",
            paramLabel = "URI",
            description =
                    "MongoDB of the stored missions, for instance mongodb://127.0.0.1:27017: replays of missing missions "
                            + "are refused, and markers are stored there. @FILE reads the URI, and so its password, from a file. "
                            + "Default: none; every replay is accepted, and there are no markers.")
    private String mongo;

    @Option(names = "--mongo-database", paramLabel = "NAME", description = "Its database. Default: ${DEFAULT-VALUE}.")
    private String database = "persistence";

    @Option(
            names = "--mongo-poll",
            paramLabel = "DURATION",
            defaultValue = "2s",
            description = "Poll interval for new and deleted missions. Default: ${DEFAULT-VALUE}.")
    private Duration poll;

    @Option(
            names = "--replay-grace",
            paramLabel = "DURATION",
            defaultValue = "1h",
            description = "How long topics of a replay are kept after its end. Default: ${DEFAULT-VALUE}.")
    private Duration grace;

    @Option(
            names = "--keep-ended-replays",
            paramLabel = "DURATION",
            defaultValue = "1h",
            description =
                    "How long seeks and steps are possible after a replay has reached its end. Default: ${DEFAULT-VALUE}.")
    private Duration endedRetention;

    @Option(
            names = "--max-replays",
            paramLabel = "N",
            description =
                    "Maximum number of concurrent replays; a further start is refused. Default: ${DEFAULT-VALUE}.")
    private int max = 256;

    /** @throws CommandException if they are invalid */
    public ReplaySettings settings() {
        if (poll.compareTo(Duration.ofMillis(100)) < 0 || grace.isNegative() || endedRetention.isNegative()) {
            throw new CommandException(
                    "--mongo-poll is at least 100ms, and --replay-grace and --keep-ended-replays are not negative; they are %s, %s and %s."
                            .formatted(poll, grace, endedRetention));
        }
        if (max < 1) {
            throw new CommandException("--max-replays is at least 1; it is %d.".formatted(max));
        }
        return ReplaySettings.DEFAULT
                .withMongo(mongo)
                .withDatabase(database)
                .withPollInterval(poll)
                .withGrace(grace)
                .withEndedRetention(endedRetention)
                .withMax(max);
    }
}

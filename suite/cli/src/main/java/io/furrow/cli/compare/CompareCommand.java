package io.furrow.cli.compare;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Instant;
import java.util.List;
import java.util.OptionalLong;
import java.util.Properties;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.KafkaClient;
import io.furrow.cli.option.OutputOptions;
import io.furrow.cli.time.TimeConverter;

/** {@code ./furrow replay compare}. */
@Command(
        name = "compare",
        abbreviateSynopsis = true,
        exitCodeOnExecutionException = 2,
        description = {
            "Compares the analytics results of one replay with those of another, or live ones: encounters by "
                    + "pair, averages by field and window, stays by device and field, all in original event time. Reads "
                    + "from Kafka what is there now; of a replay, the newest epoch.",
            "Exit code: 0 where both are the same, 1 where they differ, 2 where they cannot be compared."
        })
public final class CompareCommand implements Callable<Integer> {
    private static final String SIDE = "A replay, MISSION.ID; its topic; or live.";

    @Spec
    private CommandSpec spec;

    @Parameters(index = "0", paramLabel = "A", description = SIDE)
    private String a;

    @Parameters(index = "1", paramLabel = "B", description = SIDE)
    private String b;

    @Option(
            names = "--kafka",
            paramLabel = "HOST:PORT",
            defaultValue = KafkaClient.DEFAULT,
            description = "Kafka to read from. " + KafkaClient.DEFAULTS)
    private String kafka;

    @Option(
            names = "--kafka-properties",
            paramLabel = "FILE",
            description = "Properties for the Kafka client, for instance security settings.")
    private Path kafkaProperties;

    @Option(
            names = "--from",
            paramLabel = "TIME",
            description = "Only results at or after this original event time, " + TimeConverter.FORMS
                    + " Required with live.")
    private Instant from;

    @Option(
            names = "--to",
            paramLabel = "TIME",
            description = "Only results before this original event time. Default: with live now.")
    private Instant to;

    @Option(
            names = "--epoch-a",
            paramLabel = "N",
            description = "Epoch of A, from 0. Default: that of --epoch, else the newest.")
    private Long epochA;

    @Option(names = "--epoch-b", paramLabel = "N", description = "Epoch of B, likewise.")
    private Long epochB;

    @Option(names = "--epoch", paramLabel = "N", description = "Epoch of both. Default: the newest of each.")
    private Long epoch;

    @Option(
            names = "--mission",
            paramLabel = "NAME",
            description =
                    "Only live encounters and stays of devices of this mission; averages are those of all devices in a "
                            + "field. Default: the mission of the replay.")
    private String mission;

    @Mixin
    private final OutputOptions output = new OutputOptions();

    @Option(
            names = "--limit",
            paramLabel = "N",
            description = "Most differences of each kind in the table. Default: ${DEFAULT-VALUE}.")
    private int limit = 40;

    @Option(
            names = "--html",
            paramLabel = "FILE",
            description = "Also draw both over time into this file, a self-contained HTML page.")
    private Path html;

    @Override
    public Integer call() {
        TimeRange range = range();
        Properties client = KafkaClient.settings(kafka, kafkaProperties);
        try (ResultReader reader = new ResultReader(client)) {
            Comparison comparison = compare(reader, range);
            if (comparison.isEmpty()) {
                throw new CommandException(
                        "Nothing was compared: neither %s nor %s has a result there. Check --from and --to, or wait for analytics."
                                .formatted(comparison.a().name(), comparison.b().name()));
            }
            if (html != null) {
                Files.writeString(html, ComparisonHtml.of(comparison));
            }
            print(comparison);
            return comparison.isSame() ? 0 : 1;
        } catch (IOException e) {
            throw new CommandException("cannot write: " + e.getMessage() + "; check --html", e);
        }
    }

    private Comparison compare(ResultReader reader, TimeRange range) {
        Side first = Side.of(a, reader.topics());
        Side second = Side.of(b, reader.topics());
        String named = mission != null ? mission : first.isLive() ? second.mission() : first.mission();
        return Comparison.of(
                found(reader.read(first, epoch(epochA), first.isLive() ? named : null)),
                found(reader.read(second, epoch(epochB), second.isLive() ? named : null)),
                range);
    }

    private static SideResults found(SideResults results) {
        if (results.missing().containsAll(List.of(ResultKind.values()))) {
            throw new CommandException(
                    "There are no results of %s: start analytics on it (./furrow replay start --analytics), and wait for them"
                            .formatted(results.name()));
        }
        return results;
    }

    private OptionalLong epoch(Long ofSide) {
        Long desired = ofSide == null ? epoch : ofSide;
        return desired == null ? OptionalLong.empty() : OptionalLong.of(desired);
    }

    private void print(Comparison comparison) throws IOException {
        output.print(
                spec.commandLine().getOut(),
                ComparisonJson.of(comparison),
                new ComparisonTable(limit).lines(comparison),
                List.of(comparison.a().name(), comparison.b().name()));
    }

    private TimeRange range() {
        boolean live = a.equals(Side.LIVE) || b.equals(Side.LIVE);
        if (live && from == null) {
            throw refused("live goes on all the time: say since when with --from");
        } else if (a.equals(b) && epochA == null && epochB == null) {
            throw refused("A and B are the same; name two of them, or two epochs with --epoch-a and --epoch-b");
        }
        TimeRange range = new TimeRange(
                from == null ? TimeRange.ALL.from() : from.toEpochMilli(),
                to != null ? to.toEpochMilli() : live ? System.currentTimeMillis() : TimeRange.ALL.to());
        if (range.from() >= range.to()) {
            throw refused("--to must be after --from");
        }
        return range;
    }

    private ParameterException refused(String reason) {
        return new ParameterException(spec.commandLine(), reason);
    }
}

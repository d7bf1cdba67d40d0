package io.furrow.cli.compare;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Instant;
import java.util.List;
import java.util.OptionalLong;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.KafkaOptions;
import io.furrow.cli.time.TimeConverter;

/** {@code ./furrow replay compare}. */
@Command(
        name = "compare",
        abbreviateSynopsis = true,
        exitCodeOnExecutionException = 2,
        description = {
            "Compares the analytics results of one replay with those of another, or live ones: encounters by "
                    + "pair, averages by field and window, stays by device and field, all in original event time. Reads "
                    + "what is there now; of a replay, the newest epoch.",
            "Exit code: 0 where both are the same, 1 where they differ, 2 where they cannot be compared."
        })
public final class CompareCommand implements Callable<Integer> {
    private static final String SIDE = "A replay, MISSION.ID; its topic; or live.";

    @Parameters(index = "0", paramLabel = "A", description = SIDE)
    private String a;

    @Parameters(index = "1", paramLabel = "B", description = SIDE)
    private String b;

    @Mixin
    private ControlOptions control;

    @Mixin
    private KafkaOptions kafka;

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

    @Option(
            names = {"-n", "--limit"},
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
        boolean[] same = new boolean[1];
        int code = control.run(api -> {
            Comparison comparison = compare(api, range);
            if (html != null) {
                Files.writeString(html, ComparisonHtml.of(comparison));
            }
            control.print(
                    ComparisonJson.of(comparison),
                    any -> new ComparisonTable(limit).lines(comparison),
                    any -> List.of(comparison.a().name(), comparison.b().name()));
            same[0] = comparison.isSame();
        });
        return code != 0 ? code : same[0] ? 0 : 1;
    }

    private Comparison compare(ControlApi api, TimeRange range) {
        try (ResultTopics topics = control.isGiven("--kafka") ? new KafkaTopics(kafka.client()) : new ApiTopics(api)) {
            Comparison comparison = compare(new ResultReader(topics), range);
            if (comparison.isEmpty()) {
                throw new CommandException(
                        "Nothing was compared: neither %s nor %s has a result there. Check --from and --to, or wait for analytics."
                                .formatted(comparison.a().name(), comparison.b().name()));
            }
            return comparison;
        }
    }

    private Comparison compare(ResultReader reader, TimeRange range) {
        Side first = Side.of(a, reader.topics());
        Side second = Side.of(b, reader.topics());
        String named = mission != null ? mission : first.isLive() ? second.mission() : first.mission();
        return Comparison.of(
                found(reader.read(first, epoch(epochA), first.isLive() ? named : null, range.from())),
                found(reader.read(second, epoch(epochB), second.isLive() ? named : null, range.from())),
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

    private TimeRange range() {
        boolean live = a.equals(Side.LIVE) || b.equals(Side.LIVE);
        if (live && from == null) {
            throw control.refused("live goes on all the time: say since when with --from");
        } else if (a.equals(b) && epochA == null && epochB == null) {
            throw control.refused("A and B are the same; name two of them, or two epochs with --epoch-a and --epoch-b");
        }
        TimeRange range = new TimeRange(
                from == null ? TimeRange.ALL.from() : from.toEpochMilli(),
                to != null ? to.toEpochMilli() : live ? System.currentTimeMillis() : TimeRange.ALL.to());
        if (range.from() >= range.to()) {
            throw control.refused("--to must be after --from");
        }
        return range;
    }
}

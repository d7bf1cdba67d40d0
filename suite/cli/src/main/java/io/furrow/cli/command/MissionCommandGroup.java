package io.furrow.cli.command;

import java.io.BufferedOutputStream;
import java.io.File;
import java.io.IOException;
import java.io.OutputStream;
import java.io.UncheckedIOException;
import java.util.ArrayList;
import java.util.List;
import java.util.function.LongConsumer;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.mongodb.MongoException;
import org.apache.flink.core.fs.Path;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.MarkerCommand;
import io.furrow.cli.control.MissionControl;
import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.client.ListLimit;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.option.CommandException;
import io.furrow.cli.recording.ApiStore;
import io.furrow.cli.recording.DirectStore;
import io.furrow.cli.recording.ExportFormat;
import io.furrow.cli.recording.MissionStore;
import io.furrow.flink.job.FileSystemOptions;
import io.furrow.mission.archive.MissionArchive;
import io.furrow.mission.archive.MissionFiles;
import io.furrow.mission.export.ExportResult;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.Counts;
import io.furrow.model.text.FailureText;

/** {@code ./furrow mission}. */
@Command(
        name = "mission",
        description = "Creates, starts, follows and stops missions; exports, imports and archives their recordings.",
        addMethodSubcommands = false,
        synopsisSubcommandLabel = "COMMAND",
        subcommands = MarkerCommand.class)
public final class MissionCommandGroup extends MissionControl {
    private static final String MISSION = "Name of the mission, as its entities or as 'mission list' have it.";
    private static final String FILES = ", on any file system of Flink: a path, file:, hdfs:, s3: …";

    /** Options for the stores of missions. */
    static final class StoreOptions {
        @Option(
                names = "--mongo",
                paramLabel = "URI",
                description =
                        "Use this MongoDB itself, not the control plane with its roles and its audit; @FILE reads "
                                + "the URI, and so its password, from a file.")
        private String mongo = "";

        @Mixin
        private final FileSystemOptions fileSystems = new FileSystemOptions();
    }

    /** An operation on stored missions. */
    private interface Work {
        void with(MissionStore missions) throws IOException, InterruptedException;
    }

    @Command(
            name = "stored",
            description = "Lists the stored missions: how many events each one has, from when to when.")
    int listStored(@Mixin ControlOptions control, @Mixin StoreOptions store, @Mixin ListLimit limit) {
        limit.check(control);
        return run(control, store, missions -> {
            ControlApi.Page listed = missions.list(limit);
            control.print(
                    listed.elements(),
                    new ControlTable("No mission is stored.")
                            .text("MISSION", "/mission")
                            .text("EVENTS", "/events")
                            .time("FIRST", "/first")
                            .time("LAST", "/last"));
            limit.remark(control, listed);
        });
    }

    @Command(
            name = "export",
            description =
                    "Writes all events of a mission in the order of their times, and its markers. The same events give "
                            + "the same bytes.")
    int export(
            @Mixin ControlOptions control,
            @Mixin StoreOptions store,
            @Parameters(paramLabel = "MISSION", description = MISSION) String mission,
            @Parameters(
                            paramLabel = "FILE",
                            description =
                                    "Where to" + FILES + " Compressed where the name ends in .gz; - for the terminal.")
                    String file,
            @Option(
                            names = "--format",
                            paramLabel = "FORMAT",
                            defaultValue = "jsonl",
                            description =
                                    "jsonl, a JSON object a line, which import reads, with a file of the markers beside it; mcap, a channel for each "
                                            + "entity, for Foxglove; geojson, a track or point for each entity, for maps. "
                                            + "Default: ${DEFAULT-VALUE}.")
                    ExportFormat format) {
        return run(control, store, missions -> {
            if (file.equals("-")) {
                OutputStream terminal = new BufferedOutputStream(System.out);
                format.write(missions, mission, terminal, ignored -> {});
                terminal.flush();
                return;
            }
            requireFolder(new Path(file));
            ExportResult[] done = new ExportResult[1];
            MissionFiles.write(new Path(file), out -> {
                done[0] = format.write(missions, mission, out, progress(control, "exported"));
                return done[0].events();
            });
            ObjectNode answer =
                    NgsiJson.object().put("mission", mission).put("file", file).put("events", done[0].events());
            format.writeMarkers(missions, mission, new Path(file))
                    .ifPresent(markers -> answer.put("markers", markers.toString()));
            done[0].example()
                    .ifPresent(
                            example -> answer.put("leftOut", done[0].leftOut()).put("example", example));
            control.print(answer, MissionCommandGroup::exported);
        });
    }

    private static List<String> exported(JsonNode answer) {
        List<String> lines = new ArrayList<>();
        lines.add("%s of %s in %s"
                .formatted(
                        Counts.of(answer.path("events").asLong(), "event"),
                        answer.path("mission").asText(),
                        answer.path("file").asText()));
        if (answer.has("markers")) {
            lines.add("its markers in " + answer.path("markers").asText());
        }
        if (answer.has("leftOut")) {
            lines.add("%,d left out, the first: %s"
                    .formatted(
                            answer.path("leftOut").asLong(),
                            answer.path("example").asText()));
        }
        return lines;
    }

    @Command(
            name = "import",
            description =
                    "Reads events into a mission. Events that it already has are skipped, so an interrupted import can "
                            + "be repeated.")
    int importFrom(
            @Mixin ControlOptions control,
            @Mixin StoreOptions store,
            @Parameters(paramLabel = "MISSION", description = MISSION) String mission,
            @Parameters(
                            paramLabel = "FILE",
                            description = "A file, or a folder of an archive" + FILES
                                    + " Compressed where the name ends in .gz.")
                    String file) {
        return run(control, store, missions -> {
            long count = MissionFiles.importFrom(missions, mission, new Path(file), progress(control, "imported"));
            control.answered(
                    NgsiJson.object().put("mission", mission).put("file", file).put("events", count),
                    "%s of %s now in mission %s".formatted(Counts.of(count, "event"), file, mission));
        });
    }

    @Command(
            name = "archive",
            description =
                    "Adds missing events of missions to an archive: one file per day and mission, and another one for "
                            + "later events. Nothing in an archive is changed or removed.")
    int archive(
            @Mixin ControlOptions control,
            @Mixin StoreOptions store,
            @Parameters(paramLabel = "ROOT", description = "Folder of the archive" + FILES) String root,
            @Parameters(paramLabel = "MISSION", arity = "1..*", description = "Names of the missions.")
                    List<String> names) {
        return run(control, store, missions -> {
            ArrayNode answer = NgsiJson.array();
            for (String mission : names) {
                MissionArchive.Outcome done = missions.archive(mission, new Path(root));
                answer.addObject()
                        .put("mission", mission)
                        .put("added", done.added())
                        .put("files", done.files())
                        .put("before", done.kept())
                        .put("folder", missions.folder(mission, new Path(root)).toString());
            }
            control.print(
                    answer,
                    all -> all.valueStream().map(MissionCommandGroup::archived).toList());
        });
    }

    private static String archived(JsonNode mission) {
        return "%s: %s added in %s, %,d there before, in %s"
                .formatted(
                        mission.path("mission").asText(),
                        Counts.of(mission.path("added").asLong(), "event"),
                        Counts.of(mission.path("files").asLong(), "file"),
                        mission.path("before").asLong(),
                        mission.path("folder").asText());
    }

    private static int run(ControlOptions control, StoreOptions store, Work work) {
        return control.run(api -> with(control, store, api, work));
    }

    private static void with(ControlOptions control, StoreOptions store, ControlApi api, Work work) throws IOException {
        store.fileSystems.initialize();
        try (MissionStore missions = control.isGiven("--mongo") ? new DirectStore(store.mongo) : new ApiStore(api)) {
            work.with(missions);
        } catch (IllegalArgumentException e) {
            throw control.refused(
                    "%s. Check --mongo and the file's name.".formatted(MongoAccess.fault(store.mongo, e)));
        } catch (MongoException e) {
            throw new CommandException(
                    "MongoDB at %s: %s. Check that it runs, and --mongo."
                            .formatted(new MongoAccess(store.mongo, null), FailureText.of(e)),
                    e);
        } catch (UncheckedIOException e) {
            throw e.getCause();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new CommandException("interrupted", e);
        }
    }

    /** Flink would make a local folder that is not there, which is rather a misspelled one. */
    private static void requireFolder(Path file) throws IOException {
        File folder = new File(file.getPath()).getAbsoluteFile().getParentFile();
        if (!file.getFileSystem().isDistributedFS() && folder != null && !folder.isDirectory()) {
            throw new CommandException("There is no folder %s; make it first.".formatted(folder));
        }
    }

    private static LongConsumer progress(ControlOptions control, String done) {
        return count -> {
            if (control.isForPeople()) {
                control.out().printf("\r  %s %s", Counts.of(count, "event"), done);
                control.out().flush();
            }
        };
    }
}

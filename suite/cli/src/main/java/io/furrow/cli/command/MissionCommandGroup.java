package io.furrow.cli.command;

import java.io.File;
import java.io.IOException;
import java.io.OutputStream;
import java.io.PrintWriter;
import java.io.UncheckedIOException;
import java.util.List;
import java.util.function.LongConsumer;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.mongodb.MongoException;
import org.apache.flink.core.fs.Path;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

import io.furrow.cli.control.MarkerCommand;
import io.furrow.cli.control.MissionControl;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.option.ExportFormat;
import io.furrow.cli.option.OutputOptions;
import io.furrow.flink.job.FileSystemOptions;
import io.furrow.mission.archive.MissionArchive;
import io.furrow.mission.archive.MissionFiles;
import io.furrow.mission.archive.StoredMissions;
import io.furrow.mission.export.ExportResult;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.Counts;
import io.furrow.model.text.FailureText;

/** {@code ./furrow mission}. */
@Command(
        name = "mission",
        description = "Creates, starts, follows and stops missions; exports, imports and archives their recordings in "
                + "MongoDB.",
        addMethodSubcommands = false,
        synopsisSubcommandLabel = "COMMAND",
        subcommands = MarkerCommand.class)
public final class MissionCommandGroup extends MissionControl {
    private static final String MISSION = "Name of the mission, as its entities or as 'mission list' have it.";
    private static final ControlTable STORED = new ControlTable("No mission is stored.")
            .text("MISSION", "/mission")
            .text("EVENTS", "/events")
            .time("FIRST", "/first")
            .time("LAST", "/last");
    private static final String FILES = ", on any file system of Flink: a path, file:, hdfs:, s3: …";

    @Spec
    private CommandSpec spec;

    /** Options for the stores of missions. */
    static final class StoreOptions {
        @Spec(Spec.Target.MIXEE)
        private CommandSpec spec;

        @Option(
                names = "--mongo",
                paramLabel = "URI",
                defaultValue = "${env:FURROW_MONGO:-mongodb://127.0.0.1:27017}",
                description = "MongoDB; @FILE reads the URI, and so its password, from a file. Default: $FURROW_MONGO, "
                        + "else that of a suite on this machine, mongodb://127.0.0.1:27017.")
        private String mongo;

        @Mixin
        private final FileSystemOptions fileSystems = new FileSystemOptions();
    }

    /** An operation on the missions of MongoDB. */
    private interface Work {
        void with(StoredMissions missions) throws IOException, InterruptedException;
    }

    @Command(
            name = "stored",
            description = "Lists the stored missions: how many events each one has and from when to when.")
    int listStored(@Mixin StoreOptions store, @Mixin OutputOptions output) {
        return run(store, missions -> {
            ArrayNode stored = NgsiJson.array();
            missions.all()
                    .forEach(mission -> stored.addObject()
                            .put("mission", mission.mission())
                            .put("events", mission.events())
                            .put("first", mission.first().toString())
                            .put("last", mission.last().toString()));
            output.print(out(), stored, STORED.lines(stored), STORED.names(stored));
        });
    }

    @Command(
            name = "export",
            description =
                    "Writes all events of a mission in the order of their times, and its markers. The same events give "
                            + "the same bytes.")
    int export(
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
        return run(store, missions -> {
            requireStored(missions, mission);
            if (file.equals("-")) {
                OutputStream terminal = new java.io.BufferedOutputStream(System.out);
                format.write(new ExportFormat.Source(missions, store.mongo, mission), terminal, ignored -> {});
                terminal.flush();
                return;
            }
            requireFolder(new Path(file));
            ExportFormat.Source source = new ExportFormat.Source(missions, store.mongo, mission);
            ExportResult[] done = new ExportResult[1];
            MissionFiles.write(new Path(file), out -> {
                done[0] = format.write(source, out, progress("exported"));
                return done[0].events();
            });
            out().printf("%s of %s in %s%n", Counts.of(done[0].events(), "event"), mission, file);
            format.writeMarkers(source, new Path(file))
                    .ifPresent(markers -> out().printf("its markers in %s%n", markers));
            done[0].example()
                    .ifPresent(example -> out().printf("%,d left out, the first: %s%n", done[0].leftOut(), example));
        });
    }

    @Command(
            name = "import",
            description =
                    "Reads events into a mission. Events that it already has are skipped, so an interrupted import can "
                            + "be repeated.")
    int importFrom(
            @Mixin StoreOptions store,
            @Parameters(paramLabel = "MISSION", description = MISSION) String mission,
            @Parameters(
                            paramLabel = "FILE",
                            description = "A file, or a folder of an archive" + FILES
                                    + " Compressed where the name ends in .gz.")
                    String file) {
        return run(store, missions -> {
            long count = MissionFiles.importFrom(missions, mission, new Path(file), progress("imported"));
            out().printf("%s of %s now in mission %s%n", Counts.of(count, "event"), file, mission);
        });
    }

    @Command(
            name = "archive",
            description =
                    "Adds missing events of missions to an archive: one file per day and mission, and another one for "
                            + "later events. Nothing in an archive is changed or removed.")
    int archive(
            @Mixin StoreOptions store,
            @Parameters(paramLabel = "ROOT", description = "Folder of the archive" + FILES) String root,
            @Parameters(paramLabel = "MISSION", arity = "1..*", description = "Names of the missions.")
                    List<String> names) {
        return run(store, missions -> {
            MissionArchive archive = new MissionArchive(missions, new Path(root));
            for (String mission : names) {
                requireStored(missions, mission);
                MissionArchive.Outcome done = archive.archive(mission);
                out().printf(
                                "%s: %s added in %s, %,d there before, in %s%n",
                                mission,
                                Counts.of(done.added(), "event"),
                                Counts.of(done.files(), "file"),
                                done.kept(),
                                archive.folder(mission));
            }
        });
    }

    private int run(StoreOptions store, Work work) {
        store.fileSystems.initialize();
        try (StoredMissions missions = StoredMissions.open(store.mongo)) {
            work.with(missions);
            out().flush();
            return 0;
        } catch (IllegalArgumentException e) {
            throw new ParameterException(
                    store.spec.commandLine(),
                    "%s. Check --mongo and the file's name.".formatted(MongoAccess.fault(store.mongo, e)),
                    e);
        } catch (MongoException e) {
            return failed("MongoDB at %s: %s. Check that it runs, and --mongo."
                    .formatted(new MongoAccess(store.mongo, null), FailureText.of(e)));
        } catch (UncheckedIOException e) {
            return failed(FailureText.of(e.getCause()));
        } catch (IOException e) {
            return failed(FailureText.of(e));
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return failed("interrupted");
        }
    }

    private static void requireStored(StoredMissions missions, String mission) throws IOException {
        if (!missions.has(mission)) {
            throw new IOException(
                    "No mission named %s is stored; ./furrow mission stored shows those that are.".formatted(mission));
        }
    }

    /** Flink would make a local folder that is not there, which is rather a misspelled one. */
    private static void requireFolder(Path file) throws IOException {
        File folder = new File(file.getPath()).getAbsoluteFile().getParentFile();
        if (!file.getFileSystem().isDistributedFS() && folder != null && !folder.isDirectory()) {
            throw new IOException("There is no folder %s; make it first.".formatted(folder));
        }
    }

    private int failed(String message) {
        spec.commandLine().getErr().println(message);
        return spec.exitCodeOnExecutionException();
    }

    private LongConsumer progress(String done) {
        return count -> {
            out().printf("\r  %s %s", Counts.of(count, "event"), done);
            out().flush();
        };
    }

    private PrintWriter out() {
        return spec.commandLine().getOut();
    }
}

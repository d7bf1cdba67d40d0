package io.furrow.cli.command;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.cli.Commands;
import io.furrow.embedded.EmbeddedMongo;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class MissionCommandGroupTest {
    private static final String LINE =
            "{\"id\":\"e%d\",\"time\":17000000%05d,\"headers\":{\"origin\":\"notification\"},"
                    + "\"entity\":{\"id\":\"t\",\"n\":{\"value\":1.50}}}\n";

    private final StringWriter out = new StringWriter();
    private final StringWriter err = new StringWriter();

    @TempDir
    private Path directory;

    @AutoClose
    private EmbeddedMongo mongo;

    @BeforeEach
    void start() {
        mongo = EmbeddedMongo.start(directory.resolve("mongo"));
    }

    @Test
    void bringsAMissionBackFromItsFile() throws Exception {
        String lines = LINE.formatted(1, 1) + LINE.formatted(2, 2);
        Files.writeString(directory.resolve("in.ndjson"), lines);

        assertThat(run("import", "weeding", directory.resolve("in.ndjson").toString()))
                .isZero();
        assertThat(run("export", "weeding", directory.resolve("out.ndjson").toString()))
                .isZero();
        assertThat(run("stored")).isZero();
        assertThat(run("stored", "-o", "yaml")).isZero();
        assertThat(run("export", "weeding", directory.resolve("nodir/out").toString()))
                .isNotZero();

        assertThat(directory.resolve("nodir")).doesNotExist();
        assertThat(err.toString()).contains("There is no folder " + directory.resolve("nodir"));
        assertThat(Files.readString(directory.resolve("out.ndjson"), UTF_8)).isEqualTo(lines);
        assertThat(out.toString())
                .contains("2 events of weeding in", "- mission: \"weeding\"\n  events: 2\n")
                .containsPattern("weeding +2 +\\S+ +\\S+");
    }

    @Test
    void archivesWhatIsNewOnly() throws Exception {
        Files.writeString(directory.resolve("in.ndjson"), LINE.formatted(1, 1));
        run("import", "weeding", directory.resolve("in.ndjson").toString());

        assertThat(run("archive", directory.resolve("archive").toString(), "weeding"))
                .isZero();
        assertThat(run("archive", directory.resolve("archive").toString(), "weeding"))
                .isZero();

        assertThat(out.toString())
                .contains("weeding: 1 event added in 1 file, 0 there before")
                .contains("weeding: 0 events added in 0 files, 1 there before");
    }

    @Test
    void reportsThatAMissionIsNotStored() {
        assertThat(run("export", "weedin", directory.resolve("out").toString())).isNotZero();

        assertThat(err.toString()).contains("No mission named weedin is stored", "./furrow mission stored");
        assertThat(directory.resolve("out")).doesNotExist();
    }

    @Test
    void reportsThatMongoIsUnavailable() {
        mongo.close();

        assertThat(run("stored")).isNotZero();

        assertThat(err.toString()).contains("MongoDB at 127.0.0.1:", "Check that it runs, and --mongo.");
    }

    private int run(String... args) {
        CommandLine furrow = Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL);
        furrow.setOut(new PrintWriter(out, true));
        furrow.setErr(new PrintWriter(err, true));
        String[] all = new String[args.length + 3];
        all[0] = "mission";
        all[1] = args[0];
        all[2] = "--mongo";
        all[3] = mongo.uri() + "/?serverSelectionTimeoutMS=1000";
        System.arraycopy(args, 1, all, 4, args.length - 1);
        return furrow.execute(all);
    }
}

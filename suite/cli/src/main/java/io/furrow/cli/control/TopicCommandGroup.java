package io.furrow.cli.control;

import java.util.List;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.control.table.RecordPage;
import io.furrow.cli.option.CommandGroup;

/** {@code ./furrow topic}. */
@Command(
        name = "topic",
        description = "Lists topics, and shows, follows and finds their records.",
        addMethodSubcommands = false,
        synopsisSubcommandLabel = "COMMAND")
public final class TopicCommandGroup extends CommandGroup {
    /** The dashboard answers {@code /api/topics} itself. */
    static final String TOPICS = "/api/v1/topics";

    private static final String TOPIC = "A topic, data.* or service.*, for instance data.raw.";

    @Command(name = "list", description = "Lists the topics that can be read, and those of dead letters.")
    int list(@Mixin ControlOptions control, @Mixin ListOptions list) {
        return list.show(
                control,
                TOPICS,
                new ControlTable("There are no topics.")
                        .text("TOPIC", "/topic")
                        .text("PARTITIONS", "/partitions")
                        .text("RECORDS", "/records"));
    }

    @Command(name = "tail", description = "Prints the newest records of a topic, with their values.")
    int tail(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "TOPIC", description = TOPIC) String topic,
            @Option(
                            names = "--key",
                            paramLabel = "KEY",
                            description = "Only records with this key, in data.raw the id of the entity.")
                    String key,
            @Mixin RecordTail tail) {
        return tail.print(control, topic, key, RecordPage::line);
    }

    @Command(name = "show", description = "Shows one record with its headers and its value.")
    int show(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "RECORD", description = RecordPlace.FORM + "data.raw-0@17.") String record) {
        return control.showPage(TOPICS + RecordPlace.of(control, record).path("/records"), RecordPage::of);
    }

    @Command(
            name = "find",
            description =
                    "Finds the newest records about a device, or with a text: in the topics that are named, else in "
                            + "all data.* except those of replays. Without --since and --to, in the last hour.")
    int find(
            @Mixin ControlOptions control,
            @Parameters(paramLabel = "TOPIC", arity = "0..*", description = TOPIC) List<String> topics,
            @Mixin RecordSearch search) {
        return search.print(control, topics);
    }

    /** The path of the records of a topic. */
    static String records(String topic) {
        return TOPICS + ControlApi.part(topic) + "/records";
    }
}

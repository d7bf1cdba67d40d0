package io.furrow.cli.command;

import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.Map;
import java.util.Set;
import java.util.stream.Collectors;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

import io.furrow.cli.dead.Redrive;
import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.HelpOption;
import io.furrow.cli.option.KafkaClient;
import io.furrow.model.text.Counts;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;

/** {@code ./furrow dead-letters}. */
@Command(
        name = "dead-letters",
        description = "Records that could not be processed.",
        synopsisSubcommandLabel = "COMMAND")
public final class DeadLettersCommand {
    @Spec
    private CommandSpec spec;

    @Mixin
    private HelpOption help;

    @Command(
            name = "redrive",
            abbreviateSynopsis = true,
            description =
                    "Writes dead letters unchanged to the topic that they were read from, each once. Use it after the "
                            + "cause has been repaired.")
    int redrive(
            @Option(
                            names = "--kafka",
                            paramLabel = "HOST:PORT",
                            defaultValue = "127.0.0.1:9092",
                            description = "Kafka brokers to start from. Default: ${DEFAULT-VALUE}.")
                    String kafka,
            @Option(
                            names = "--kafka-properties",
                            paramLabel = "FILE",
                            description = "Properties for the Kafka clients, for instance security settings.")
                    Path kafkaProperties,
            @Option(
                            names = "--topic",
                            paramLabel = "TOPIC",
                            defaultValue = "data.raw.dead",
                            description = "Topic of the dead letters. Default: ${DEFAULT-VALUE}.")
                    String topic,
            @Option(
                            names = "--to",
                            paramLabel = "TOPIC",
                            description =
                                    "Topic to write them to. Default: that of --topic without '.dead'. Dead letters of the NGSI source "
                                            + "are notifications; their topic is ngsi.notifications.")
                    String to,
            @Option(
                            names = "--reason",
                            paramLabel = "CODE,…",
                            split = ",",
                            hideParamSyntax = true,
                            description = "Only those with one of these reasons, for instance not-json. Default: all.")
                    Set<String> reasons,
            @Option(
                            names = "--stage",
                            paramLabel = "NAME,…",
                            split = ",",
                            hideParamSyntax = true,
                            description =
                                    "Only those of these stages. Default: all but routes, ingest-images, missions and the "
                                            + "analytics jobs, where the event itself was processed and would become a duplicate.")
                    Set<String> stages,
            @Option(names = "--again", description = "Also those that this command has sent back before.")
                    boolean again,
            @Option(names = "--dry-run", description = "Count them, write nothing.") boolean dryRun,
            @Mixin HelpOption requested) {
        String target = to == null ? Topics.ofDeadLetters(topic).orElseThrow(() -> nameless(topic)) : to;
        Redrive.Choice choice = new Redrive.Choice(
                reasons == null ? Set.of() : Set.copyOf(reasons), stages == null ? Set.of() : Set.copyOf(stages));
        Redrive.Request request = new Redrive.Request(topic, target, choice, again, dryRun);
        try {
            print(request, new Redrive(KafkaClient.settings(kafka, kafkaProperties), request).run());
            return 0;
        } catch (IOException | org.apache.kafka.common.KafkaException e) {
            throw new CommandException("Dead letters of %s at %s: %s".formatted(topic, kafka, FailureText.of(e)), e);
        }
    }

    private ParameterException nameless(String topic) {
        return new ParameterException(
                spec.subcommands().get("redrive"),
                "--topic " + topic + " does not end in '.dead'; say with --to where its records go");
    }

    private void print(Redrive.Request request, Redrive.Outcome outcome) {
        PrintWriter out = spec.commandLine().getOut();
        out.printf(
                "%s %s from %s to %s%s%n",
                request.dryRun() ? "would send" : "sent",
                Counts.of(outcome.total(), "dead letter"),
                request.from(),
                request.to(),
                listed(": ", outcome.fed()));
        if (!outcome.left().isEmpty()) {
            out.println("left where they are" + listed(": ", outcome.left()));
        }
        out.flush();
    }

    private static String listed(String before, Map<String, Long> counts) {
        return counts.isEmpty()
                ? ""
                : before
                        + counts.entrySet().stream()
                                .map(count -> count.getValue() + " " + count.getKey())
                                .collect(Collectors.joining(", "));
    }
}

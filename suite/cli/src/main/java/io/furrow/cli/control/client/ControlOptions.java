package io.furrow.cli.control.client;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.UncheckedIOException;
import java.net.URI;
import java.nio.file.FileSystemException;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.function.Function;
import javax.net.ssl.SSLContext;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

import io.furrow.cli.control.table.AnswerText;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.control.table.CredentialList;
import io.furrow.cli.option.Contexts;
import io.furrow.cli.option.HttpUriConverter;
import io.furrow.cli.option.OutputOptions;
import io.furrow.model.file.FileProblem;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.FailureText;

/** Common options of the commands that use the control plane: its address, the credentials, and the format of the output. */
public final class ControlOptions {
    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(
            names = "--api",
            paramLabel = "URL",
            converter = HttpUriConverter.class,
            defaultValue = "${env:FURROW_API:-" + Contexts.DEFAULT_API + "}",
            description = {
                "REST API of the control plane.",
                "Default: $FURROW_API, else " + Contexts.DEFAULT_API
                        + "." // a line of its own: it would be divided at a dot
            })
    private URI api;

    @Option(
            names = "--token-file",
            paramLabel = "FILE",
            description =
                    "File with the token for the control plane: its first line is a token, or '<name> <token> <role>' as "
                            + "in the file of the control plane. Default: the token in $FURROW_TOKEN, else the file "
                            + "$FURROW_TOKEN_FILE. That of a context is sent to the API of the context only.")
    private Path tokenFile;

    @Option(
            names = "--api-ca",
            paramLabel = "FILE",
            defaultValue = "${env:FURROW_API_CA}",
            description =
                    "PEM file with the certificates to trust where the control plane is reached over https. Default: "
                            + "$FURROW_API_CA, else those that Java trusts.")
    private Path ca;

    @Mixin
    private final OutputOptions output = new OutputOptions();

    /** A use of the API. */
    public interface Work {
        void with(ControlApi api) throws IOException;
    }

    /** A use of the API for one of several names. */
    public interface NamedWork {
        void with(ControlApi api, String name) throws IOException;
    }

    /** Prints the content of a path as rows of a table; one object is one row. */
    public int show(String path, ControlTable table) {
        return run(api -> print(api.get(path), table));
    }

    /** Prints the rows of a table. */
    public void print(JsonNode answer, ControlTable table) throws IOException {
        print(answer, all -> table.lines(ControlTable.rows(all)), all -> table.names(ControlTable.rows(all)));
    }

    /** Prints a list by its lines, which are as wide as the terminal, or its names. */
    public void print(JsonNode answer, Function<JsonNode, List<String>> lines, Function<JsonNode, List<String>> names)
            throws IOException {
        if (output.isName()) {
            names.apply(answer).forEach(out()::println);
        } else {
            print(answer, all -> output.table(lines.apply(all)));
        }
    }

    /** Prints the object at a path, a member per line. */
    public int showOne(String path) {
        return showPage(path, AnswerText::members);
    }

    /** Prints the object at a path as a page. */
    public int showPage(String path, Function<JsonNode, List<String>> page) {
        return run(api -> print(api.get(path), page));
    }

    /** Prints the credentials at a path, of one device or of many. */
    public int showCredentials(String path) {
        return runWith(api -> {
            if (output.isCsv()) {
                out().print(api.text(path, "text/csv"));
                return;
            }
            JsonNode answer = api.get(path);
            JsonNode devices = answer.isArray()
                    ? answer
                    : JsonNodeFactory.instance.arrayNode().add(answer);
            if (output.isEnv()) {
                CredentialList.env(devices).forEach(out()::println);
            } else {
                print(answer, answer.isArray() ? CredentialList.table()::lines : AnswerText::members);
            }
        });
    }

    /** Sends a command and prints the answer. */
    public int command(String method, String path, JsonNode body) {
        return run(api -> answered(api.send(method, path, body)));
    }

    /** Sends a command to each path and prints the answers, a line each. */
    public int commands(String method, List<String> paths, JsonNode body) {
        return each(api -> paths, (api, path) -> answered(api.send(method, path, body)));
    }

    /** Sends a command and prints the answer, and the members of the command. */
    public int commandEchoed(String method, String path, ObjectNode body) {
        return run(api -> {
            JsonNode answer = api.send(method, path, body);
            String members = AnswerText.sentence(body);
            answered(
                    answer,
                    answer.path("status").asText("done") + ": " + AnswerText.sentence(answer)
                            + (members.isEmpty() ? "" : ", " + members));
        });
    }

    /** Sends a command and prints the answer. @param done a sentence about the effect */
    public int commandDone(String method, String path, String done) {
        return run(api -> done(api.send(method, path, null), done));
    }

    /** Sends a command and prints the object in the answer, a member per line. */
    public int commandShown(String method, String path) {
        return run(api -> print(api.send(method, path, null), AnswerText::members));
    }

    /** Prints the answer to a command. */
    public void answered(JsonNode answer) throws IOException {
        done(answer, answer.path("status").asText("done"));
    }

    /** Prints the answer to a command. @param done a word about the effect */
    public void done(JsonNode answer, String done) throws IOException {
        answered(answer, done + ": " + AnswerText.sentence(answer));
    }

    /** Prints the answer to a command. @param sentence about the effect */
    public void answered(JsonNode answer, String sentence) throws IOException {
        print(answer, any -> List.of(sentence));
    }

    /** Prints an object as a page. */
    public void print(JsonNode answer, Function<JsonNode, List<String>> page) throws IOException {
        if (output.isForPeople()) {
            page.apply(answer).forEach(out()::println);
        } else if (output.isName()) {
            ControlTable.rows(answer).forEach(row -> out().println(AnswerText.name(row)));
        } else {
            print(answer);
        }
    }

    /** Runs it and prints a sentence if it fails. @return the exit code */
    public int run(Work work) {
        if (output.isCsv() || output.isEnv()) {
            throw refused(OutputOptions.CREDENTIALS_ONLY);
        }
        return runWith(work);
    }

    /** Runs it for each name, also after one was refused. @return the exit code, 0 if none was */
    public int each(Function<ControlApi, List<String>> names, NamedWork work) {
        boolean[] refused = new boolean[1];
        int code = run(api -> {
            int done = 0;
            for (String name : names.apply(api)) {
                try {
                    output.separate(out(), done++);
                    work.with(api, name);
                } catch (ControlPlaneException e) {
                    if (e.problem() == null) {
                        throw e; // it would be the same for the others
                    }
                    refused[0] = true;
                    spec.commandLine().getErr().println(reason(e));
                }
            }
        });
        return refused[0] ? failed() : code;
    }

    private int failed() {
        return spec.commandLine().getCommandSpec().exitCodeOnExecutionException();
    }

    private int runWith(Work work) {
        try {
            work.with(client());
            out().flush();
            return 0;
        } catch (ControlPlaneException e) {
            spec.commandLine().getErr().println(reason(e));
        } catch (FileSystemException e) {
            spec.commandLine()
                    .getErr()
                    .println("%s cannot be read or written: %s".formatted(e.getFile(), FileProblem.of(e)));
        } catch (IOException e) {
            spec.commandLine().getErr().println("cannot read or write: " + FailureText.of(e));
        }
        return failed();
    }

    private String reason(ControlPlaneException rejection) {
        try {
            return output.isWhole() && rejection.problem() != null
                    ? output.text(rejection.problem())
                    : rejection.sentence(spec);
        } catch (IOException e) { // it was read from JSON
            throw new UncheckedIOException(e);
        }
    }

    /** Whether an option is on the command line, so that it is not a default. */
    public boolean isGiven(String option) {
        return spec.commandLine().getParseResult().hasMatchedOption(option);
    }

    /** Rejects the arguments of a command. */
    public ParameterException refused(String reason) {
        return new ParameterException(spec.commandLine(), reason);
    }

    /** Prints a sentence below an answer, or beside it where that is for programs. */
    public void remark(String sentence) {
        (isForPeople() ? out() : spec.commandLine().getErr()).println(sentence);
    }

    /** Prints a sentence about what went wrong. */
    public void warn(String sentence) {
        spec.commandLine().getErr().println(sentence);
    }

    public boolean isForPeople() {
        return output.isForPeople();
    }

    /** Prints an answer in YAML if that is the form, else in JSON. */
    public void print(JsonNode answer) throws IOException {
        out().println(output.text(answer));
    }

    public PrintWriter out() {
        return spec.commandLine().getOut();
    }

    /** An object of the members that are present. */
    public static ObjectNode object(Map<String, ?> members) {
        ObjectNode json = JsonNodeFactory.instance.objectNode();
        members.forEach((name, value) -> {
            if (value != null) {
                json.set(name, NgsiJson.mapper().valueToTree(value));
            }
        });
        return json;
    }

    /** Connects to nothing yet. */
    private ControlApi client() {
        try {
            boolean isOfOther = !isGiven("--token-file")
                    && spec.commandLine().getDefaultValueProvider() instanceof Contexts contexts
                    && !contexts.isOwnApi(api);
            String token = ClientToken.find(isOfOther ? null : tokenFile, System.getenv())
                    .orElse(null);
            SSLContext trust = ca == null ? null : TrustedCertificates.context(ca);
            return new ControlApi(api, token, trust, output.isForPrograms());
        } catch (IOException e) {
            throw new ParameterException(spec.commandLine(), e.getMessage(), e);
        }
    }
}

package io.furrow.cli.control.client;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.UncheckedIOException;
import java.net.URI;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.function.Function;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
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
import io.furrow.cli.option.HttpUriConverter;
import io.furrow.cli.option.OutputOptions;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.FailureText;

/** Common options of the commands that use the control plane: its address, the credentials, and the format of the output. */
public final class ControlOptions {
    private static final Pattern MEMBER = Pattern.compile("(?:\\ba member |^)'(\\w+)'");

    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(
            names = "--api",
            paramLabel = "URL",
            converter = HttpUriConverter.class,
            defaultValue = "${env:FURROW_API:-http://127.0.0.1:8085}",
            description = "REST API of the control plane. Default: $FURROW_API, else http://127.0.0.1:8085.")
    private URI api;

    @Option(
            names = "--token-file",
            paramLabel = "FILE",
            description =
                    "File with the token for the control plane: its first line is a token, or '<name> <token> <role>' as "
                            + "in the file of the control plane. Default: the token in $FURROW_TOKEN, else the file "
                            + "$FURROW_TOKEN_FILE.")
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

    /** Prints the content of a path as rows of a table; one object is one row. */
    public int show(String path, ControlTable table) {
        return run(api -> print(api.get(path), table));
    }

    /** Prints the rows of a table. */
    public void print(JsonNode answer, ControlTable table) throws IOException {
        print(answer, all -> table.lines(rows(all)), all -> table.names(rows(all)));
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
        return run(api -> {
            JsonNode answer = api.send(method, path, null);
            answered(answer, done + ": " + AnswerText.sentence(answer));
        });
    }

    /** Sends a command and prints the object in the answer, a member per line. */
    public int commandShown(String method, String path) {
        return run(api -> print(api.send(method, path, null), AnswerText::members));
    }

    /** Prints the answer to a command. */
    public void answered(JsonNode answer) throws IOException {
        answered(answer, answer.path("status").asText("done") + ": " + AnswerText.sentence(answer));
    }

    /** Prints the answer to a command. @param sentence about the effect */
    public void answered(JsonNode answer, String sentence) throws IOException {
        print(answer, any -> List.of(sentence));
    }

    private void print(JsonNode answer, Function<JsonNode, List<String>> page) throws IOException {
        if (output.isForPeople()) {
            page.apply(answer).forEach(out()::println);
        } else if (output.isName()) {
            rows(answer).forEach(row -> out().println(AnswerText.name(row)));
        } else {
            print(answer);
        }
    }

    /** Runs it and prints a sentence if it fails. @return the exit code */
    public int run(Work work) {
        if (output.isCsv() || output.isEnv()) {
            throw refused("--output csv and env are for 'device credentials'; use table, wide, json, yaml or name");
        }
        return runWith(work);
    }

    private int runWith(Work work) {
        try {
            work.with(new ControlApi(api, token(), trust()));
            out().flush();
            return 0;
        } catch (ControlPlaneException e) {
            spec.commandLine().getErr().println(reason(e));
        } catch (IOException e) {
            spec.commandLine().getErr().println("cannot read or write: " + FailureText.of(e));
        }
        return spec.commandLine().getCommandSpec().exitCodeOnExecutionException();
    }

    private String reason(ControlPlaneException rejection) {
        try {
            return output.isForPeople() || output.isName() || rejection.problem() == null
                    ? inOptions(rejection.getMessage())
                    : output.text(rejection.problem());
        } catch (IOException e) { // it was read from JSON
            throw new UncheckedIOException(e);
        }
    }

    /** Names the option where the control plane names the member of the request that was made of it. */
    private String inOptions(String message) {
        return MEMBER.matcher(message).replaceAll(named -> {
            String option = "--" + named.group(1).replaceAll("([A-Z])", "-$1").toLowerCase(Locale.ROOT);
            return Matcher.quoteReplacement(spec.findOption(option) == null ? named.group() : option);
        });
    }

    /** Rejects the arguments of a command. */
    public ParameterException refused(String reason) {
        return new ParameterException(spec.commandLine(), reason);
    }

    /** Prints a sentence below an answer, or beside it where that is for programs. */
    public void remark(String sentence) {
        (isForPeople() ? out() : spec.commandLine().getErr()).println(sentence);
    }

    public boolean isForPeople() {
        return output.isForPeople();
    }

    /** Prints an answer in YAML if that is the form, else in JSON. */
    public void print(JsonNode answer) throws IOException {
        out().println(output.text(answer));
    }

    public static String pretty(JsonNode json) throws IOException {
        return NgsiJson.mapper().writerWithDefaultPrettyPrinter().writeValueAsString(json);
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

    /** A list may be the answer itself, or the only list of an object. */
    private static JsonNode rows(JsonNode answer) {
        if (answer.isArray()) {
            return answer;
        }
        for (JsonNode member : answer) {
            if (member.isArray() && answer.size() == 1) {
                return member;
            }
        }
        return JsonNodeFactory.instance.arrayNode().add(answer);
    }

    private String token() {
        try {
            return ClientToken.find(tokenFile, System.getenv()).orElse(null);
        } catch (IOException e) {
            throw new ParameterException(spec.commandLine(), e.getMessage(), e);
        }
    }

    private SSLContext trust() {
        try {
            return ca == null ? null : TrustedCertificates.context(ca);
        } catch (IOException e) {
            throw new ParameterException(spec.commandLine(), "--api-ca " + e.getMessage(), e);
        }
    }
}

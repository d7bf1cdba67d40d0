package io.furrow.cli.option;

import java.io.IOException;
import java.io.PrintWriter;
import java.util.List;
import java.util.Locale;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.dataformat.yaml.YAMLGenerator;
import com.fasterxml.jackson.dataformat.yaml.YAMLMapper;
import picocli.CommandLine.Option;

import io.furrow.model.ngsi.NgsiJson;

/** The option {@code --output}: the form in which a command prints its answer. */
public final class OutputOptions {
    /** The reason why csv and env are refused. */
    public static final String CREDENTIALS_ONLY =
            "--output csv and env are for 'device credentials'; use table, wide, json, yaml or name";

    private enum Form {
        TABLE,
        WIDE,
        JSON,
        YAML,
        NAME,
        CSV,
        ENV;

        /** As it is written on the command line. */
        @Override
        public String toString() {
            return name().toLowerCase(Locale.ROOT);
        }
    }

    @Option(
            names = {"-o", "--output"},
            paramLabel = "FORM",
            defaultValue = "table",
            description =
                    "table, whose lines are cut to the width of the terminal; wide, with whole lines; json or yaml; "
                            + "name, names only; of credentials also csv and env. Default: ${DEFAULT-VALUE}.")
    private Form form;

    /** Whether the answer is printed as lines for people. */
    public boolean isForPeople() {
        return form == Form.TABLE || form == Form.WIDE;
    }

    /** Whether the answer is printed as it is, in JSON or YAML. */
    public boolean isForPrograms() {
        return form == Form.JSON || form == Form.YAML;
    }

    public boolean isName() {
        return form == Form.NAME;
    }

    public boolean isCsv() {
        return form == Form.CSV;
    }

    public boolean isEnv() {
        return form == Form.ENV;
    }

    /** Separates documents of YAML. @param before how many were printed before */
    public void separate(PrintWriter out, int before) {
        if (before > 0 && form == Form.YAML) {
            out.println("---");
        }
    }

    /** Prints an answer in its form. @param lines a table @param names a line each */
    public void print(PrintWriter out, JsonNode answer, List<String> lines, List<String> names) throws IOException {
        if (isName()) {
            names.forEach(out::println);
        } else if (isForPeople()) {
            table(lines).forEach(out::println);
        } else {
            out.println(text(answer));
        }
        out.flush();
    }

    /** Returns an answer in YAML if that is the form, else in JSON. */
    public String text(JsonNode answer) throws IOException {
        if (isCsv() || isEnv()) {
            throw new CommandException(CREDENTIALS_ONLY);
        }
        return form == Form.YAML
                ? new YAMLMapper()
                        .disable(YAMLGenerator.Feature.WRITE_DOC_START_MARKER)
                        .writeValueAsString(
                                NgsiJson.mapper().readTree(NgsiJson.mapper().writeValueAsBytes(answer)))
                        .stripTrailing()
                : NgsiJson.mapper().writerWithDefaultPrettyPrinter().writeValueAsString(answer);
    }

    /** Returns the lines of a table as wide as the terminal, or whole where there is none. */
    public List<String> table(List<String> lines) {
        String columns = System.getenv("COLUMNS"); // set at a terminal only
        return form == Form.TABLE && columns != null && columns.matches("[1-9][0-9]{0,4}")
                ? cut(lines, Integer.parseInt(columns))
                : lines;
    }

    static List<String> cut(List<String> lines, int width) {
        return lines.stream()
                .map(line -> line.length() <= width ? line : line.substring(0, width - 1) + "…")
                .toList();
    }
}

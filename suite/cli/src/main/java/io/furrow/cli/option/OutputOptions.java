package io.furrow.cli.option;

import java.io.IOException;
import java.io.PrintWriter;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.dataformat.yaml.YAMLGenerator;
import com.fasterxml.jackson.dataformat.yaml.YAMLMapper;
import picocli.CommandLine.ITypeConverter;
import picocli.CommandLine.Option;
import picocli.CommandLine.TypeConversionException;

import io.furrow.model.ngsi.NgsiJson;

/** The option {@code --output}: the form in which a command prints its answer. */
public final class OutputOptions {
    /** The reason why csv and env are refused. */
    public static final String CREDENTIALS_ONLY =
            "--output csv and env are for 'device credentials'; use table, wide, json, yaml, name or jsonpath=";

    private enum Form {
        TABLE,
        WIDE,
        JSON,
        YAML,
        NAME,
        JSONPATH,
        CSV,
        ENV;

        /** As it is written on the command line. */
        @Override
        public String toString() {
            return name().toLowerCase(Locale.ROOT) + (this == JSONPATH ? "=" : "");
        }
    }

    /** A form as it is given, with the template of that form; null for none. */
    private record Output(Form form, JsonPathTemplate template) {}

    /** Reads a form. */
    private static final class Converter implements ITypeConverter<Output> {
        @Override
        public Output convert(String text) {
            if (text.startsWith(Form.JSONPATH.toString())) {
                try {
                    String template = text.substring(Form.JSONPATH.toString().length());
                    return new Output(Form.JSONPATH, JsonPathTemplate.parse(template));
                } catch (IllegalArgumentException e) {
                    throw new TypeConversionException(e.getMessage());
                }
            }
            return Stream.of(Form.values())
                    .filter(form -> form.toString().equalsIgnoreCase(text))
                    .findFirst()
                    .map(form -> new Output(form, null))
                    .orElseThrow(() -> new TypeConversionException(
                            "expected one of %s but was '%s'".formatted(List.of(Form.values()), text)));
        }
    }

    /** The forms, for completion. */
    private static final class Names extends ArrayList<String> {
        private static final long serialVersionUID = 1L;

        Names() {
            super(Stream.of(Form.values()).map(Form::toString).toList());
        }
    }

    @Option(
            names = {"-o", "--output"},
            paramLabel = "FORM",
            defaultValue = "table",
            converter = Converter.class,
            completionCandidates = Names.class,
            description =
                    "table, whose lines are cut to the width of the terminal; wide, with whole lines; json or yaml; "
                            + "name, names only; jsonpath=TEMPLATE as in kubectl, for instance "
                            + "'jsonpath={.items[*].mission}'; of credentials also csv and env. Default: ${DEFAULT-VALUE}.")
    private Output output;

    /** Whether the answer is printed as lines for people. */
    public boolean isForPeople() {
        return is(Form.TABLE) || is(Form.WIDE);
    }

    /** Whether the answer is printed as it is, in JSON or YAML, or values of it. */
    public boolean isForPrograms() {
        return isWhole() || is(Form.JSONPATH);
    }

    /** Whether the answer is printed as it is, in JSON or YAML. */
    public boolean isWhole() {
        return is(Form.JSON) || is(Form.YAML);
    }

    public boolean isName() {
        return is(Form.NAME);
    }

    public boolean isCsv() {
        return is(Form.CSV);
    }

    public boolean isEnv() {
        return is(Form.ENV);
    }

    /** Separates documents of YAML. @param before how many were printed before */
    public void separate(PrintWriter out, int before) {
        if (before > 0 && is(Form.YAML)) {
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

    /** Returns an answer in YAML, or values of it, if that is the form, else in JSON. */
    public String text(JsonNode answer) throws IOException {
        if (isCsv() || isEnv()) {
            throw new CommandException(CREDENTIALS_ONLY);
        }
        if (is(Form.JSONPATH)) {
            return output.template().print(answer).replaceFirst("\n$", ""); // it ends a line by itself
        }
        return is(Form.YAML)
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
        return is(Form.TABLE) && columns != null && columns.matches("[1-9][0-9]{0,4}")
                ? cut(lines, Integer.parseInt(columns))
                : lines;
    }

    private boolean is(Form form) {
        return output.form() == form;
    }

    static List<String> cut(List<String> lines, int width) {
        return lines.stream()
                .map(line -> line.length() <= width ? line : line.substring(0, width - 1) + "…")
                .toList();
    }
}

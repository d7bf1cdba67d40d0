package io.furrow.bench.command;

import java.io.IOException;
import java.io.PrintWriter;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.bench.analytics.Figures;
import io.furrow.model.ngsi.NgsiJson;

/** Where the figures of a measurement go: the terminal at once, a file of JSON in the end, plots if asked for. */
final class AnalyticsFigures {
    private final PrintWriter out;
    private final Path plots;
    private final ObjectNode json = JsonNodeFactory.instance.objectNode();

    private AnalyticsFigures(PrintWriter out, Path plots) {
        this.out = out;
        this.plots = plots;
    }

    /** @param plots folder of the pictures, made where it is missing; null for none */
    static AnalyticsFigures to(PrintWriter out, Path plots) throws IOException {
        if (plots != null) {
            Files.createDirectories(plots);
        }
        return new AnalyticsFigures(out, plots);
    }

    /** Says how far it is. */
    void tell(String line) {
        out.println("  " + line);
        out.flush();
    }

    void add(String name, Figures figures) {
        figures.print(out);
        json.set(name, figures.json());
    }

    /** A further object of the file, to be filled. */
    ObjectNode object(String name) {
        return json.putObject(name);
    }

    /** Keeps a picture in SVG. */
    void draw(String name, String svg) throws IOException {
        if (plots != null) {
            Files.writeString(plots.resolve(name + ".svg"), svg, StandardCharsets.UTF_8);
        }
    }

    /** Writes every figure. */
    void write(Path output) throws IOException {
        Files.write(output, NgsiJson.write(json));
    }
}

package io.furrow.bench.component;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.ObjectMapper;

import io.furrow.bench.component.Component.Rates;

/** Turns of components, in a file of JSON lines that grows: a measurement that was interrupted goes on where it was. */
public final class ComponentResults {
    private static final ObjectMapper JSON = new ObjectMapper();

    private final Path file;
    private final List<Turn> turns = new ArrayList<>();

    /** A line of the file. */
    record Turn(String commit, int turn, Component component, double ours, double peers) {}

    private ComponentResults(Path file) {
        this.file = file;
    }

    /**
     * Begins with what the file holds; it need not exist.
     *
     * @throws IOException if it holds something else
     */
    public static ComponentResults in(Path file) throws IOException {
        ComponentResults all = new ComponentResults(file);
        if (Files.exists(file)) {
            for (String line : Files.readAllLines(file)) {
                try {
                    all.turns.add(JSON.readValue(line, Turn.class));
                } catch (IOException e) {
                    throw new IOException(
                            file + " is no file of './furrow bench components'; name one that is, or a new one", e);
                }
            }
        }
        return all;
    }

    public boolean has(String commit, int turn, Component component) {
        return turns.stream()
                .anyMatch(each -> each.commit.equals(commit) && each.turn == turn && each.component == component);
    }

    public void add(String commit, int turn, Component component, Rates rates) throws IOException {
        Turn added = new Turn(commit, turn, component, rates.ours(), rates.peers());
        Files.writeString(
                file,
                JSON.writeValueAsString(added) + "\n",
                StandardCharsets.UTF_8,
                StandardOpenOption.CREATE,
                StandardOpenOption.APPEND);
        turns.add(added);
    }

    /** The commit that was measured last. */
    public String commit() {
        return turns.isEmpty() ? "none" : turns.get(turns.size() - 1).commit;
    }

    /** All turns of a component, of that commit. */
    public List<Rates> of(Component component) {
        return turns.stream()
                .filter(each -> each.commit.equals(commit()) && each.component == component)
                .map(each -> new Rates(each.ours, each.peers))
                .toList();
    }
}

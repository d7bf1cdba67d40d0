package io.furrow.bench.component;

import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;

import io.furrow.bench.component.Component.Rates;
import io.furrow.bench.results.JsonLines;

/** Stores turns of components in a file. */
final class ComponentResults {
    private final JsonLines<Turn> turns;

    /** A line of the file. */
    record Turn(String commit, int turn, Component component, double ours, double peers, Map<String, Double> others) {}

    private ComponentResults(JsonLines<Turn> turns) {
        this.turns = turns;
    }

    /**
     * Reads the file, if it exists.
     *
     * @throws IOException if its content is invalid
     */
    static ComponentResults in(Path file) throws IOException {
        return new ComponentResults(JsonLines.in(file, Turn.class, "components"));
    }

    boolean has(String commit, int turn, Component component) {
        return turns.all().stream()
                .anyMatch(each -> each.commit.equals(commit) && each.turn == turn && each.component == component);
    }

    void add(String commit, int turn, Component component, Rates rates) throws IOException {
        turns.add(new Turn(commit, turn, component, rates.ours(), rates.peers(), rates.others()));
    }

    /** The most recently measured commit. */
    String commit() {
        List<Turn> all = turns.all();
        return all.isEmpty() ? "none" : all.get(all.size() - 1).commit;
    }

    /** All turns of a component, of that commit. */
    List<Rates> of(Component component) {
        return turns.all().stream()
                .filter(each -> each.commit.equals(commit()) && each.component == component)
                .map(each -> new Rates(each.ours, each.peers, each.others))
                .toList();
    }
}

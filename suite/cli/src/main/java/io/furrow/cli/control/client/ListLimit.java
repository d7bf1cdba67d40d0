package io.furrow.cli.control.client;

import com.fasterxml.jackson.databind.node.ArrayNode;
import picocli.CommandLine.Option;

import io.furrow.model.ngsi.NgsiJson;

/** The option {@code --limit} of lists of what there is, which are read by pages. */
public final class ListLimit {
    private static final int PAGE = 1_000;
    private static final int MAX_LISTED = 20_000;

    @Option(
            names = {"-n", "--limit"},
            paramLabel = "N",
            defaultValue = "10000",
            description = "How many at most, 1 to 20000. Default: ${DEFAULT-VALUE}.")
    private int limit;

    /** Rejects a limit. */
    public static void check(ControlOptions control, int limit, int max) {
        if (limit < 1 || limit > max) {
            throw control.refused("--limit is 1 to %d, not %d".formatted(max, limit));
        }
    }

    /** Rejects a limit that is too small or too large. */
    public void check(ControlOptions control) {
        check(control, limit, MAX_LISTED);
    }

    /** Reads the list at a path. */
    public ControlApi.Page read(ControlApi api, String path) {
        return api.list(path + (path.contains("?") ? "&" : "?") + "limit=" + Math.min(limit, PAGE), limit);
    }

    /** Limits a list that was read otherwise. */
    public ControlApi.Page cut(ArrayNode all) {
        ArrayNode elements = NgsiJson.array();
        all.valueStream().limit(limit).forEach(elements::add);
        return new ControlApi.Page(elements, all.size() > limit);
    }

    /** Prints a sentence if there are more elements than a list shows. */
    public void remark(ControlOptions control, ControlApi.Page listed) {
        if (listed.hasMore()) {
            control.remark("There are more than %d; --limit shows more of them.".formatted(limit));
        }
    }
}

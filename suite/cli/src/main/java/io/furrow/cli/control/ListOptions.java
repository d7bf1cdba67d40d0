package io.furrow.cli.control;

import java.util.stream.Stream;

import picocli.CommandLine.Option;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.table.ControlTable;

/** The options of lists of what there is, which are read by pages. */
final class ListOptions extends ListWatch {
    private static final int PAGE = 1_000;
    private static final int MAX_LISTED = 20_000;

    @Option(
            names = {"-n", "--limit"},
            paramLabel = "N",
            defaultValue = "10000",
            description = "How many at most, 1 to 20000. Default: ${DEFAULT-VALUE}.")
    private int limit;

    ListOptions() {}

    /** @param pollMillis time between two requests of {@code --watch} */
    ListOptions(long pollMillis) {
        super(pollMillis);
    }

    /** Rejects a limit. */
    static void check(ControlOptions control, int limit, int max) {
        if (limit < 1 || limit > max) {
            throw control.refused("--limit is 1 to %d, not %d".formatted(max, limit));
        }
    }

    /** Prints the list at a path as a table. @param selectors paths of what selects its rows, which must exist */
    int show(ControlOptions control, String path, ControlTable table, String... selectors) {
        check(control, limit, MAX_LISTED);
        String pages = path + (path.contains("?") ? "&" : "?") + "limit=" + Math.min(limit, PAGE);
        return control.run(api -> {
            ControlApi.Page listed = api.list(pages, limit);
            if (listed.elements().isEmpty()) {
                Stream.of(selectors).forEach(api::get);
            }
            control.print(listed.elements(), table);
            if (listed.hasMore()) {
                control.remark("There are more than %d; --limit shows more of them.".formatted(limit));
            }
            follow(control, listed.elements(), () -> api.list(pages, limit).elements(), table);
        });
    }
}

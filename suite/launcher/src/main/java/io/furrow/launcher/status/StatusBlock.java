package io.furrow.launcher.status;

import java.util.ArrayList;
import java.util.List;

/**
 * The lines of the live status, most important first: lists that do not fit are cut, with the number of omitted members.
 *
 * @param results averages of fields
 * @param collisions the newest first
 * @param notices a sentence for each condition that requires action
 * @param jobs a line each
 * @param topics a line for each active one, the fastest first
 * @param idle number of other topics
 * @param addresses of all parts, the page first
 */
record StatusBlock(
        List<String> results,
        List<String> collisions,
        List<String> notices,
        List<String> jobs,
        List<String> topics,
        int idle,
        List<String> addresses) {
    /** Rows of old terminals; results then leave half of the rest to jobs and topics. */
    private static final int FEW = 24;

    private static final int SHARES = 4;

    /** Without a limit. */
    List<String> lines() {
        return lines(Integer.MAX_VALUE);
    }

    /** @param rows maximum number of lines */
    List<String> lines(int rows) {
        List<String> lines = new ArrayList<>();
        int share = Math.max(rows, FEW) / SHARES;
        addresses.stream()
                .limit(Math.min(1, rows))
                .map(page -> page + "   Ctrl-C stops Furrow")
                .forEach(lines::add);
        add(lines, "", notices, 0, share, rows);
        add(lines, "averages", results, 0, share, rows);
        add(lines, "collisions", collisions, 0, share, rows);
        add(lines, "%-52s %10s".formatted("job", "to read"), jobs, 0, rows, rows);
        add(lines, "%-52s %10s %12s".formatted("topic", "per second", "total"), topics, idle, rows, rows);
        if (addresses.size() < rows - lines.size()) {
            add(lines, "addresses", addresses, 0, rows, rows);
        }
        return lines;
    }

    /** @param unsaid number of omitted members */
    private static void add(List<String> lines, String title, List<String> members, int unsaid, int share, int rows) {
        int room = Math.min(share, rows - lines.size()) - (title.isEmpty() ? 0 : 1);
        if (room <= 0 || members.isEmpty() && unsaid == 0) {
            return;
        }
        if (!title.isEmpty()) {
            lines.add(title);
        }
        int shown = members.size() + (unsaid > 0 ? 1 : 0) <= room ? members.size() : room - 1;
        members.stream().limit(shown).map(member -> "  " + member).forEach(lines::add);
        int more = members.size() - shown + unsaid;
        if (more > 0) {
            lines.add("  … and %d more".formatted(more));
        }
    }
}

package io.furrow.cli.control;

import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.option.Confirmation;

/** Selects missions that run or are scheduled: by name, those of a domain, or all. */
final class MissionChoice {
    private static final Set<String> ACTIVE = Set.of("starting", "running");

    @Parameters(paramLabel = "MISSION", arity = "0..*", description = "Names of the missions.")
    private List<String> names;

    @Option(names = "--all", description = "All missions that run or are scheduled.")
    private boolean all;

    @Option(
            names = "--domain",
            paramLabel = "DOMAIN",
            description = "The missions of this domain that run or are scheduled.")
    private String domain;

    /** Rejects arguments that select in no way or in several. */
    void check(ControlOptions control) {
        if (Stream.of(names != null, domain != null, all).filter(given -> given).count() != 1) {
            throw control.refused("Name missions, or a domain with --domain, or --all.");
        }
    }

    /** Returns the names. @param verb of the question that is asked about missions that were not named */
    List<String> names(ControlOptions control, ControlApi api, Confirmation confirmation, String verb) {
        if (names != null) {
            return names;
        }
        List<String> active = new ArrayList<>();
        ControlTable.rows(api.get(MissionControl.path(domain))).forEach(mission -> {
            if (isActive(mission.path("status"))) {
                active.add(mission.path("mission").asText());
            }
        });
        if (active.isEmpty()) {
            control.remark(
                    "No mission%s runs or is scheduled.".formatted(domain == null ? "" : " of domain " + domain));
        } else {
            confirmation.ask("%s %s?".formatted(verb, Confirmation.named("mission", active)));
        }
        return active;
    }

    private static boolean isActive(JsonNode status) {
        String state = status.path("state").asText();
        return ACTIVE.contains(state) || state.equals("created") && status.hasNonNull("due");
    }
}

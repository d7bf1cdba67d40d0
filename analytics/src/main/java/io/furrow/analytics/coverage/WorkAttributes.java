package io.furrow.analytics.coverage;

import java.io.Serializable;
import java.util.Set;

/**
 * How robots are known and report their implement.
 *
 * @param types entity types of robots; empty for all
 * @param width of the working width, meters
 * @param work of the state of the implement
 * @param on its values with which the implement works, in lower case
 */
record WorkAttributes(Set<String> types, String width, String work, Set<String> on) implements Serializable {
    boolean isRobot(String type) {
        return types.isEmpty() || types.contains(type);
    }
}

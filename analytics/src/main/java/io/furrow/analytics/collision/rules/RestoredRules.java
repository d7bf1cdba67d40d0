package io.furrow.analytics.collision.rules;

import java.util.List;

import org.apache.flink.api.common.state.ListState;
import org.apache.flink.api.common.state.ListStateDescriptor;
import org.apache.flink.api.common.state.OperatorStateStore;
import org.apache.flink.api.common.typeinfo.Types;

/**
 * Compares the rules of a stage with those of its restored state.
 *
 * <p>State: the union list {@code rules-digest}.
 */
public final class RestoredRules {
    private final ListState<String> state;
    private final String digest;
    private final boolean changed;

    private RestoredRules(ListState<String> state, String digest, boolean changed) {
        this.state = state;
        this.digest = digest;
        this.changed = changed;
    }

    public static RestoredRules of(OperatorStateStore store, CollisionRules rules) throws Exception {
        ListState<String> state = store.getUnionListState(new ListStateDescriptor<>("rules-digest", Types.STRING));
        boolean changed = false;
        for (String each : state.get()) {
            changed |= !each.equals(rules.digest());
        }
        return new RestoredRules(state, rules.digest(), changed);
    }

    /** Whether the restored state was made with other rules. */
    public boolean changed() {
        return changed;
    }

    /** Writes the state for a checkpoint. */
    public void snapshot() throws Exception {
        state.update(List.of(digest));
    }
}

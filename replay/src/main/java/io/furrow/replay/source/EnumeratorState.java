package io.furrow.replay.source;

import java.util.List;

/** The checkpointed state of the enumerator: replays without a reader. Desired states are read again. */
record EnumeratorState(List<ReplaySplit> splits) {}

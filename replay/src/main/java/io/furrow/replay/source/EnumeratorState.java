package io.furrow.replay.source;

import java.util.List;

/** What the enumerator has to keep: replays that no reader has. What is requested it reads again. */
record EnumeratorState(List<ReplaySplit> splits) {}

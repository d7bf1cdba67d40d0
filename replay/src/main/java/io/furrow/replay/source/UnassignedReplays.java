package io.furrow.replay.source;

import java.util.List;

/** What the enumerator has to keep: replays that no reader has. What is wanted it reads anew. */
record UnassignedReplays(List<ReplaySplit> splits) {}

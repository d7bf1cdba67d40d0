/** Measures how punctual and how fast the job {@code replay} is, against bare loops that write the same records. */
package io.furrow.bench.replay;

/** Common parts of benchmarks: a command, the engines that it starts, a reader of topics, a table of figures, a chart. */
package io.furrow.bench.frame;

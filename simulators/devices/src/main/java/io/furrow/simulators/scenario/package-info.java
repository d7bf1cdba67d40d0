/** The file that says which devices a simulated farm has, where they are, what they do and what is wrong with them. */
package io.furrow.simulators.scenario;

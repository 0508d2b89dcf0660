// The scalar run: each kernel over its own array of stored forms, one pair at a time.
#include <bit>
#include <cstdint>
#include <memory>

#include "embree_style.h"
#include "straight.h"
#include "table1.h"

namespace pierce::bench {

namespace {

/// Reads the same cache lines and decides nothing: what is left of a kernel's time when this is taken off is its own.
struct Dummy {
    using Forms = EmbreeStyle::Stored<float>;
    template <class Number>
    using Stored = EmbreeStyle::Stored<Number>;

    template <class Scalar>
    Stored<Scalar> prepare(const Vec3<Scalar>& a, const Vec3<Scalar>& b, const Vec3<Scalar>& c) const {
        return EmbreeStyle{}.prepare(a, b, c);
    }
    kernels::Tested<float> evaluate(const Forms& t, const kernels::Triple<float>& from,
                                    const kernels::Triple<float>& to) const {
        const float sum = (t.a[0] + t.e1[1]) + (t.normal[2] + (from[0] + to[2]));
        return {sum > 1e30F};
    }
};

/// The compiler would put the branch back, to divide for hits only.
float computed(Straight x) {
#ifdef __x86_64__
    asm("" : "+x"(x.value));
#endif
    return x.value;
}

/// x or 0, by bits: compilers make a branch of the conditional operator.
float where(bool hit, float x) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) & (0U - static_cast<unsigned>(hit)));
}

/// A kernel as it is, or without its early-outs.
template <class Kernel>
struct Plain {
    Kernel kernel;
    auto operator()(const typename Kernel::template Stored<float>& t, const kernels::Triple<float>& from,
                    const kernels::Triple<float>& to) const {
        return kernel.evaluate(t, from, to);
    }
};
template <class Kernel>
struct InOneGo {
    Kernel kernel;
    kernels::Tested<float> operator()(const typename Kernel::template Stored<float>& t,
                                      const kernels::Triple<float>& from, const kernels::Triple<float>& to) const {
        using Ends = kernels::Triple<Straight>;
        const auto tested = kernel.evaluate(std::bit_cast<typename Kernel::template Stored<Straight>>(t),
                                            std::bit_cast<Ends>(from), std::bit_cast<Ends>(to));
        return {tested.hit.value, computed(tested.fraction), computed(tested.u), computed(tested.v)};
    }
};

/// No branch on the answer: that is for the kernels to have or not to have.
void add(Sums& sums, const kernels::Tested<float>& tested) {
    sums.hits += tested.hit ? 1U : 0U;
    sums.fraction += double{where(tested.hit, tested.fraction)};
    sums.u += double{where(tested.hit, tested.u)};
    sums.v += double{where(tested.hit, tested.v)};
}

template <template <class> class How = Plain, class Kernel>
void enter(Contest& contest, const std::string& name, const Kernel& kernel, const Pairs& pairs) {
    auto stored = std::make_shared<std::vector<typename Kernel::template Stored<float>>>();
    stored->reserve(pairs.size());
    for (const auto& t : pairs.triangles) stored->push_back(kernel.prepare(t[0], t[1], t[2]));
    contest.emplace_back(name, [stored, test = How<Kernel>{kernel}, &pairs] {
        Sums sums;
        const auto* forms = stored->data();
        for (std::size_t i = 0; i < pairs.size(); ++i) add(sums, test(forms[i], pairs.from[i], pairs.to[i]));
        return sums;
    });
}

/// The same with the segment in the triangle's record: one stream of memory in place of three.
template <template <class> class How = Plain, class Kernel>
void enter_interleaved(Contest& contest, const std::string& name, const Kernel& kernel, const Pairs& pairs) {
    using Form = typename Kernel::template Stored<float>;
    struct Record {
        Form form;
        kernels::Triple<float> from;
        kernels::Triple<float> to;
    };
    auto records = std::make_shared<std::vector<Record>>();
    records->reserve(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto& t = pairs.triangles[i];
        records->push_back({kernel.prepare(t[0], t[1], t[2]), pairs.from[i], pairs.to[i]});
    }
    contest.emplace_back(name, [records, test = How<Kernel>{kernel}] {
        Sums sums;
        for (const Record& r : *records) add(sums, test(r.form, r.from, r.to));
        return sums;
    });
}

/// A fan of one triangle: the first map of a stored fan.
struct OneTriangleFan {
    template <class Number>
    using Stored = kernels::TriangleFan::First<Number>;

    template <class Scalar>
    Stored<Scalar> prepare(const Vec3<Scalar>& a, const Vec3<Scalar>& b, const Vec3<Scalar>& c) const {
        return kernels::triangle_fan.prepare(a, b, c).first;
    }
    kernels::Tested<float> evaluate(const Stored<float>& first, const kernels::Triple<float>& from,
                                    const kernels::Triple<float>& to) const {
        const auto answer = kernels::triangle_fan.evaluate<float>(first, {}, from, to);
        return answer ? kernels::Tested<float>{true, answer->fraction, answer->u, answer->v}
                      : kernels::Tested<float>{false};
    }
};

}  // namespace

Contest scalar_contest(const Pairs& pairs) {
    Contest contest;
    enter(contest, "dummy", Dummy{}, pairs);
    enter(contest, "moller_trumbore", kernels::MollerTrumbore{}, pairs);
    enter(contest, "embree_style", EmbreeStyle{}, pairs);
    enter(contest, "bloom", kernels::Bloom{}, pairs);
    enter(contest, "baldwin_weber_12", kernels::BaldwinWeber12{}, pairs);
    enter(contest, "baldwin_weber_9", kernels::BaldwinWeber9{}, pairs);
    enter<InOneGo>(contest, "mt_in_one_go", kernels::MollerTrumbore{}, pairs);
    enter<InOneGo>(contest, "embree_in_one_go", EmbreeStyle{}, pairs);
    enter<InOneGo>(contest, "bloom_in_one_go", kernels::Bloom{}, pairs);
    enter<InOneGo>(contest, "bw12_in_one_go", kernels::BaldwinWeber12{}, pairs);
    enter_interleaved(contest, "mt_interleaved", kernels::MollerTrumbore{}, pairs);
    enter_interleaved(contest, "bloom_interleaved", kernels::Bloom{}, pairs);
    enter_interleaved<InOneGo>(contest, "mt_il_in_one_go", kernels::MollerTrumbore{}, pairs);
    enter_interleaved<InOneGo>(contest, "bloom_il_one_go", kernels::Bloom{}, pairs);
    enter(contest, "cramer", kernels::Cramer{}, pairs);
    enter(contest, "mcguire", kernels::McGuire{.epsilon = 0}, pairs);
    enter(contest, "triangle_fan", OneTriangleFan{}, pairs);
    enter(contest, "watertight", kernels::Watertight{}, pairs);
    return contest;
}

}  // namespace pierce::bench

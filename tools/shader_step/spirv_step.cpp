#include "spirv_step.h"

#include <fmt/format.h>
#define SPV_ENABLE_UTILITY_CODE  // spv::HasResultAndType
#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include <functional>
#include <set>
#include <span>
#include <stdexcept>

namespace sahl::shader_step {

namespace {

constexpr size_t HEADER_WORDS = 5;

/// Calls visit(opcode, words) for every instruction; words includes the first one.
void forEachInstruction(const std::vector<uint32_t>& module,
                        const std::function<void(spv::Op, std::span<const uint32_t>)>& visit)
{
    if (module.size() < HEADER_WORDS || module[0] != spv::MagicNumber) {
        throw std::runtime_error("not a SPIR-V module");
    }
    for (size_t at = HEADER_WORDS; at < module.size();) {
        size_t length = module[at] >> spv::WordCountShift;
        if (length == 0 || at + length > module.size()) {
            throw std::runtime_error("SPIR-V module is cut off");
        }
        visit(static_cast<spv::Op>(module[at] & spv::OpCodeMask), {&module[at], length});
        at += length;
    }
}

/// Float arithmetic that Vulkan promises to round correctly (division by our own means), and that
/// must be decorated so that it is not rearranged.
bool isArithmetic(spv::Op op)
{
    switch (op) {
    case spv::OpFNegate:
    case spv::OpFAdd:
    case spv::OpFSub:
    case spv::OpFMul:
    case spv::OpFDiv:
    case spv::OpVectorTimesScalar: return true;
    default: return false;
    }
}

/// Instructions that may give a float without computing: they move, choose or convert exactly.
bool isExactMove(spv::Op op)
{
    switch (op) {
    case spv::OpConstant:
    case spv::OpConstantComposite:
    case spv::OpConstantNull:
    case spv::OpUndef:
    case spv::OpLoad:
    case spv::OpFunctionCall:
    case spv::OpFunctionParameter:
    case spv::OpFunction:
    case spv::OpCompositeConstruct:
    case spv::OpCompositeExtract:
    case spv::OpCompositeInsert:
    case spv::OpVectorShuffle:
    case spv::OpVectorExtractDynamic:
    case spv::OpVectorInsertDynamic:
    case spv::OpCopyObject:
    case spv::OpPhi:
    case spv::OpSelect:
    case spv::OpBitcast:
    case spv::OpConvertUToF:
    case spv::OpConvertSToF: return true;
    default: return false;
    }
}

bool isExactBuiltIn(uint32_t instruction)
{
    // Fma is as exact as the device's own: kernels use it where the host saw that it rounds once
    return instruction == GLSLstd450Floor || instruction == GLSLstd450Sqrt || instruction == GLSLstd450Fma;
}

/// Ids of the module's float types and vectors of them.
std::set<uint32_t> floatTypes(const std::vector<uint32_t>& module)
{
    std::set<uint32_t> types;
    forEachInstruction(module, [&](spv::Op op, std::span<const uint32_t> words) {
        if (op == spv::OpTypeFloat) types.insert(words[1]);
        if ((op == spv::OpTypeVector || op == spv::OpTypeMatrix) && types.contains(words[2])) {
            types.insert(words[1]);
        }
    });
    return types;
}

}  // namespace

std::vector<std::string> refusedInstructions(const std::vector<uint32_t>& module)
{
    std::set<uint32_t> floats = floatTypes(module);
    std::vector<std::string> refused;
    forEachInstruction(module, [&](spv::Op op, std::span<const uint32_t> words) {
        if (op == spv::OpTypeFloat && words[2] != 32) {
            refused.push_back(fmt::format("float of {} bits", words[2]));
        }
        if (op == spv::OpTypeMatrix) refused.push_back("matrix type");
        if (op == spv::OpIsNan || op == spv::OpIsInf) {
            refused.push_back("isnan or isinf: test the bits instead");
        }
        bool hasResult = false;
        bool hasResultType = false;
        spv::HasResultAndType(op, &hasResult, &hasResultType);
        if (!hasResultType || !floats.contains(words[1])) return;
        if (op == spv::OpExtInst) {
            if (!isExactBuiltIn(words[4])) {
                refused.push_back(fmt::format("built-in function {} of GLSL.std.450", words[4]));
            }
        } else if (!isArithmetic(op) && !isExactMove(op)) {
            refused.push_back(fmt::format("opcode {}", static_cast<int>(op)));
        }
    });
    return refused;
}

std::vector<uint32_t> decoratedNoContraction(const std::vector<uint32_t>& module)
{
    std::set<uint32_t> floats = floatTypes(module);
    std::vector<uint32_t> decorations;
    forEachInstruction(module, [&](spv::Op op, std::span<const uint32_t> words) {
        if (isArithmetic(op) && floats.contains(words[1])) {
            constexpr uint32_t length = 3;
            decorations.insert(decorations.end(),
                               {length << spv::WordCountShift | spv::OpDecorate, words[2],
                                static_cast<uint32_t>(spv::DecorationNoContraction)});
        }
    });

    // Annotations stand before the first type.
    std::vector<uint32_t> result(module.begin(), module.begin() + HEADER_WORDS);
    bool inserted = false;
    forEachInstruction(module, [&](spv::Op op, std::span<const uint32_t> words) {
        if (!inserted && op >= spv::OpTypeVoid && op <= spv::OpTypeForwardPointer) {
            result.insert(result.end(), decorations.begin(), decorations.end());
            inserted = true;
        }
        result.insert(result.end(), words.begin(), words.end());
    });
    return result;
}

}  // namespace sahl::shader_step
